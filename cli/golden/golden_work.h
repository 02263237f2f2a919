// Doing tests: each in a process of its own, so that one that crashes takes no other down.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/golden/golden_folder.h"
#include "cli/golden/golden_tests.h"
#include "render/gl/backend.h"

namespace billow::cli {

/// Of every test.
struct GoldenWork {
  int jobs = 1;                   // at a time
  bool may_run_programs = false;  // that tests name
  render::Backend backend = {};   // that draws scenes
  bool untrusted = false;         // scenes read no file outside of the folder of the tests
};

/// Makes the pictures of those `chosen` of the tests that are not there already; says of each what it came to. Why
/// those that have none have none, by name. Stops early when a signal asks for it. Throws as run_jobs.
std::map<std::string, std::string> make_pictures(const GoldenTests& tests, const std::vector<const GoldenTest*>& chosen,
                                                 const GoldenFolder& folder, const GoldenWork& work);

/// Makes the pictures of the test of that name, in this process, which make_pictures has started. Returns an exit
/// status, or becomes the program that makes them. Throws InputError, DivergenceError, OutputError.
int make_own_pictures(const GoldenTests& tests, const std::string& name, const GoldenFolder& folder,
                      const GoldenWork& work);

}  // namespace billow::cli
