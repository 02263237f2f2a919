// What can draw here.
#pragma once

namespace billow::cli {

/// Prints a line for each backend and each device of EGL: what it is called, whether it is software or a GPU, vendor,
/// name, version and driver, or what is missing; then which of them draws here, and why. Returns the exit status: 0
/// where one does.
int print_backends();

}  // namespace billow::cli
