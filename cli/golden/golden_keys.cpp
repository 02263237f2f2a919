// Every key that a file of tests may have, with the numbers and words it accepts.
#include "cli/golden/golden_keys.h"

#include "cli/golden/golden_tests.h"

namespace billow::cli::keys {

const Section golden{"the file of tests", {{"billow_golden"}, {"baselines"}, {"tolerance"}, {"tests"}}};

const Section golden_scene{"a test of a scene",
                           {{"name"},
                            {"scene"},
                            {"set"},
                            {"frames"},
                            {"views", {}, all_words<render::View>()},
                            {"pictures", {}, all_words<RunPicture>()},
                            {"tolerance"}}};
const Section golden_folder{"a test of a folder", {{"name"}, {"folder"}, {"tolerance"}}};
const Section golden_command{"a test of a command",
                             {{"name"}, {"command"}, {"timeout", {1, 86'400, false, "s"}}, {"tolerance"}}};

}  // namespace billow::cli::keys
