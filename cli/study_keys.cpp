// Every key that a study may have, with the numbers and words it accepts.
#include "cli/study_keys.h"

#include <array>

namespace billow::cli::keys {
namespace {

// What every picture may say.
std::vector<Key> with_common(std::vector<Key> own) {
  std::vector<Key> keys = {{"name"}, {"kind", {}, picture_kinds()}, {"title"}, {"note"}, {"where"}};
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

const Key times{"times", {0.0, 1e5, false, "s"}};
const Key views{"views", {}, {"textured", "velocity"}};
const Key logarithmic{"log", {}, {"x", "y"}};

}  // namespace

const std::vector<std::string_view>& picture_kinds() {
  static const std::vector<std::string_view> kinds = {"strips", "spectra", "frames", "plot", "spectrum_curves"};
  return kinds;
}

const Section study{"the study",
                    {{"billow_study"}, {"title"}, {"about"}, {"scene"}, {"set"}, {"axes"}, {"measure"}, {"pictures"}}};

const Section axis{"axis", {{"name"}, {"key"}, {"values"}}};
const Section axis_value{"value", {{"label"}, {"set"}}};
const Section measure{"measure", {{"render"}, {"measured"}, {"repeats", {0, 100}}}};
const Section picture_strips{"picture", with_common({{"rows"}, times, {"views", {}, {"textured", "velocity"}}})};
const Section picture_spectra{"picture", with_common({{"columns"}})};
const Section picture_frames{"picture", with_common({{"rows"}, times, views})};
const Section picture_plot{"picture", with_common({{"x"}, {"y"}, {"by"}, {"x_label"}, {"y_label"}, logarithmic})};
const Section picture_spectrum_curves{"picture", with_common({{"by"}, {"x_label"}, {"y_label"}, logarithmic})};

const Section& picture(int kind) {
  const std::array<const Section*, 5> sections = {&picture_strips, &picture_spectra, &picture_frames, &picture_plot,
                                                  &picture_spectrum_curves};
  return *sections.at(static_cast<std::size_t>(kind));
}

}  // namespace billow::cli::keys
