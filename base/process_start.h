// When this process began.
#pragma once

#include <chrono>

namespace billow {

/// Before main: loading libraries counts too. To a hundredth of a second, which is the system's own unit; the time of
/// the call where the system does not say.
std::chrono::steady_clock::time_point process_start();

}  // namespace billow
