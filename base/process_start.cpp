// Linux: /proc/self/stat, see proc(5).
#include "base/process_start.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace billow {
namespace {

// Words of /proc/self/stat between the program's name and the start [tick since the system was started].
constexpr int words_before_start = 19;

double seconds_since_boot() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Its start [s since boot], in the middle of its tick; negative where it is unknown.
double start_since_boot() {
  std::ifstream file("/proc/self/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');  // the name may hold blanks and brackets
  if (name_end == std::string::npos) return -1.0;
  std::istringstream words(line.substr(name_end + 1));
  std::string skipped;
  for (int k = 0; k < words_before_start; ++k) words >> skipped;
  long long ticks = -1;
  words >> ticks;
  return words ? (static_cast<double>(ticks) + 0.5) / static_cast<double>(sysconf(_SC_CLK_TCK)) : -1.0;
}

}  // namespace

std::chrono::steady_clock::time_point process_start() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point now = Clock::now();
  const double start = start_since_boot(), age = seconds_since_boot() - start;
  if (start < 0.0 || age < 0.0) return now;
  return now - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(age));
}

}  // namespace billow
