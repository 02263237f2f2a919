// Every key that a study may have, with the numbers and words it accepts.
#include "cli/study/study_keys.h"

#include <stdexcept>

#include "render/image/views.h"

namespace billow::cli::keys {
namespace {

// What every picture may say.
std::vector<Key> with_common(std::vector<Key> own) {
  std::vector<Key> keys = {{"name"}, {"kind", {}, all_words<PictureKind>()}, {"title"}, {"note"}, {"where"}};
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

const Key times{"times", {0.0, 1e5, false, "s"}};
const Key views{"views", {}, render::png_views()};
const Key logarithmic{"log", {}, {"x", "y"}};

}  // namespace

const Section study{"the study",
                    {{"billow_study"}, {"title"}, {"about"}, {"scene"}, {"set"}, {"axes"}, {"measure"}, {"pictures"}}};

const Section axis{"axis", {{"name"}, {"key"}, {"label"}, {"values"}}};
const Section axis_value{"value", {{"label"}, {"curve"}, {"set"}}};
const Section measure{"measure", {{"render"}, {"measured"}, {"repeats", {0, 100}}, {"error"}}};
const Section error{"error", {{"until", {0.0, 1e5, true, "s"}}, {"set"}}};
const Section picture_strips{"picture", with_common({{"rows"}, times, {"views", {}, render::png_views()}})};
const Section picture_spectra{"picture", with_common({{"columns"}})};
const Section picture_frames{"picture", with_common({{"rows"}, times, views})};
const Section picture_plot{"picture", with_common({{"x"}, {"y"}, {"by"}, {"x_label"}, {"y_label"}, logarithmic})};
const Section picture_spectrum_curves{"picture", with_common({{"by"}, {"x_label"}, {"y_label"}, logarithmic})};

const std::vector<PlacedSection>& sections_of_a_study() {
  static const std::vector<PlacedSection> sections = {{"", &study},
                                                      {"axes[]", &axis},
                                                      {"axes[].values[]", &axis_value},
                                                      {"measure", &measure},
                                                      {"measure.error", &error}};
  return sections;
}

const Section& picture(PictureKind kind) {
  switch (kind) {
    case PictureKind::strips:
      return picture_strips;
    case PictureKind::spectra:
      return picture_spectra;
    case PictureKind::frames:
      return picture_frames;
    case PictureKind::plot:
      return picture_plot;
    case PictureKind::spectrum_curves:
      return picture_spectrum_curves;
  }
  throw std::logic_error("a kind of picture has no keys");
}

}  // namespace billow::cli::keys
