// The version that the build was given.
#include "cli/text/version.h"

namespace billow::cli {

std::string_view version() { return BILLOW_VERSION; }

}  // namespace billow::cli
