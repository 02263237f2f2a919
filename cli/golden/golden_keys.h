// Every key that a file of tests may have.
#pragma once

#include "cli/yaml/yaml_reader.h"

namespace billow::cli::keys {

/// The file, and a test by what its pictures are of.
extern const Section golden, golden_scene, golden_folder, golden_command;

}  // namespace billow::cli::keys
