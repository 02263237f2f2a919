// DIR/index.html: one run to look at.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/run/run_series.h"

namespace billow::cli {

/// Something that a reader must know first.
struct PageNote {
  enum class Kind { partial, look_closer, failed };
  Kind kind = Kind::look_closer;
  std::string text;
};

/// What the page of a run shows. All text is plain: the page escapes it.
struct RunPage {
  std::string title, summary;
  std::vector<PageNote> notes;
  std::vector<std::string> views;  // of PNG frames: names, also of the frames' folders
  std::string no_views;            // why there are none
  int width = 0, height = 0;       // [pixel] of a frame
  double fps = 0.0;                // frame f is at (f - 1) / fps
  long frames = 0;                 // of the whole scene
  RunSeries series;                // of a run that failed: empty
  std::vector<long> listed;        // the frames that were drawn, ascending; empty: all of the series'
  bool scattered = false;          // there are frames between those of the series
  int strip_columns = 0;           // 0: no strip
  double strip_step = 0.0;         // [s] between columns
  double spectrum_time = -1.0;     // [s] of the velocity image beside the spectrum; < 0: neither
  std::string glb, glb_script;     // the moving geometry and the script that brings it to the page; empty: none
  std::vector<std::pair<std::string, std::string>> facts;  // name, value
  std::string command;                                     // that repeats the run
  std::string scene;                                       // the effective scene
};

/// The page: refers to frames, strip and run.json beside it and to nothing else. Its size does not grow with the run.
std::string run_page_html(const RunPage& page);

}  // namespace billow::cli
