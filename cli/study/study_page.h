// index.html of a study.
#pragma once

#include <string>

#include "cli/study/study_pictures.h"

namespace billow::cli {

/// One self-contained page: the pictures first, then the runs, their parameters and values, and the command for each.
/// Pictures are referred to beside the page.
std::string study_page(const StudyContents& contents);

}  // namespace billow::cli
