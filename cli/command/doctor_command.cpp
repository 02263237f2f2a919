// billow doctor: what this build runs on.
#include <assimp/version.h>
#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <thread>

#include "cli/command/backend_list.h"
#include "cli/command/commands.h"
#include "cli/text/terminal.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

void line(std::string_view what, std::string_view value) { print_line("{:<12} {}", what, value); }

std::string cpu_features() {
  std::string features;
  const auto add = [&](bool has, const char* name) { features += has ? std::string(name) + " " : ""; };
#if defined(__x86_64__)
  add(__builtin_cpu_supports("sse4.2"), "sse4.2");
  add(__builtin_cpu_supports("avx"), "avx");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("fma"), "fma");
  add(__builtin_cpu_supports("avx512f"), "avx512f");
#endif
  return features.empty() ? "baseline" : features;
}

bool has_program(const char* program) {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    if (access((folders.substr(begin, end - begin) + "/" + program).c_str(), X_OK) == 0) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

int doctor_command() {
  line("billow", version());
  line("Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  line("assimp", fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch()));
  line("libpng", png_get_libpng_ver(nullptr));
  line("fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  line("compiler", __VERSION__);
  line("processor", fmt::format("{} threads, {}", std::thread::hardware_concurrency(), cpu_features()));
  line("gnuplot",
       has_program("gnuplot") ? "found" : "missing: plots of 'study' and 'filter' are not drawn (gnuplot-nox)");
  line("ffmpeg", has_program("ffmpeg") ? "found" : "missing: 'video' makes no film (ffmpeg)");
  return print_backends();
}

}  // namespace billow::cli
