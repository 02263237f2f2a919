// Trying every backend.
#include "cli/command/backend_list.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "base/out_of_memory.h"
#include "cli/command/application.h"
#include "cli/command/doctor_line.h"
#include "render/gl/gl_context.h"

namespace billow::cli {

namespace {

using render::Backend;
using render::BackendKind;

// Printed as soon as it is known: a broken driver may end the process. Whether it can draw.
bool try_backend(const Backend& backend) {
  try {
    const render::GlContext context(backend);
    const std::string driver = context.driver().empty() ? "" : fmt::format(", driver {}", context.driver());
    const char* kind = context.is_software() ? "software" : "GPU";
    doctor_line(text_of(backend), fmt::format("{}: {}{}", kind, context.description(), driver));
    return true;
  } catch (const std::runtime_error& error) {
    doctor_line(text_of(backend), fmt::format("missing: {}", error.what()));
    return false;
  }
}

int count_egl_devices() {
  try {
    return render::egl_devices();
  } catch (const ResourceError&) {  // the line of egl itself says so
    return 0;
  }
}

constexpr const char* why_software = "auto takes software, so that bytes repeat";

}  // namespace

int print_backends() {
  const bool has_osmesa = try_backend({BackendKind::osmesa, {}});
  const bool has_egl = try_backend({BackendKind::egl, {}});
  for (int device = 0; device < count_egl_devices(); ++device) try_backend({BackendKind::egl, device});
  try {
    const Backend asked_for = render::backend_of_environment();
    const std::string taken = text_of(render::GlContext(asked_for).backend());
    if (asked_for.kind != BackendKind::automatic)
      doctor_line("draws", fmt::format("{}, as BILLOW_BACKEND says; {} without it", taken,
                                       has_osmesa ? "osmesa"
                                       : has_egl  ? "egl"
                                                  : "nothing"));
    else
      doctor_line("draws",
                  fmt::format("{}{}: {}", taken, has_osmesa ? "" : ", because osmesa is missing", why_software));
    return exit_done;
  } catch (const std::invalid_argument& error) {
    doctor_line("draws", fmt::format("MISSING: {}", error.what()));
    return exit_usage;
  } catch (const ResourceError& error) {
    doctor_line("draws", fmt::format("MISSING: {}", error.what()));
    return exit_internal_fault;
  }
}

}  // namespace billow::cli
