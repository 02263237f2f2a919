// billow doctor: what this build runs on.
#include <assimp/version.h>
#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <thread>

#include "cli/command/backend_list.h"
#include "cli/command/build_facts.h"
#include "cli/command/commands.h"
#include "cli/command/doctor_line.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

std::string cpu_features() {
  std::string features;
  const auto add = [&](bool has, const char* name) { features += has ? std::string(", ") + name : ""; };
#if defined(__x86_64__)
  add(__builtin_cpu_supports("sse4.2"), "sse4.2");
  add(__builtin_cpu_supports("avx"), "avx");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("fma"), "fma");
  add(__builtin_cpu_supports("avx512f"), "avx512f");
#endif
  return features.empty() ? ", baseline" : features;
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

// Of those that tell their version when they run; empty for the others.
std::string loaded_version(std::string_view library) {
  if (library == "assimp")
    return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
  return library == "libpng" ? png_get_libpng_ver(nullptr) : "";
}

// "5.4.3, built with 5.2.5": another may be there than when the tool was built.
std::string version_text(std::string_view library, const std::string& built) {
  const std::string loaded = loaded_version(library);
  if (loaded.empty() || loaded == built) return built.empty() ? "version unknown" : built;
  return built.empty() ? loaded : fmt::format("{}, built with {}", loaded, built);
}

}  // namespace

int doctor_command() {
  doctor_line("billow", version());
  for (const auto& [library, built] : library_versions()) doctor_line(library, version_text(library, built));
  doctor_line("compiler", compiler_text());
  doctor_line("processor", fmt::format("{} threads{}", std::thread::hardware_concurrency(), cpu_features()));
  doctor_line("gnuplot",
              has_program("gnuplot") ? "found" : "missing: plots of 'study' and 'filter' are not drawn (gnuplot-nox)");
  doctor_line("ffmpeg", has_program("ffmpeg") ? "found" : "missing: 'video' makes no film (ffmpeg)");
  return print_backends();
}

}  // namespace billow::cli
