// Runs -> files, picture by picture.
#include "cli/study/study_pictures.h"

#include <stdexcept>

#include "cli/study/study_plots.h"
#include "cli/study/study_sheets.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

void make_picture(const StudyContents& contents, const PictureSpec& picture) {
  const std::filesystem::path stem = contents.folder / picture.name;
  if (is_plot(picture))
    render::write_plot(plot_of(contents, picture), stem);
  else
    render::write_png(stem.string() + ".png", draw_sheet(sheet_of(contents, picture)));
}

}  // namespace

std::map<std::string, std::string> make_pictures(const StudyContents& contents) {
  std::map<std::string, std::string> faults;
  for (const PictureSpec& picture : contents.study.pictures) {
    try {
      make_picture(contents, picture);
    } catch (const std::runtime_error& error) {
      faults[picture.name] = error.what();
    }
  }
  return faults;
}

}  // namespace billow::cli
