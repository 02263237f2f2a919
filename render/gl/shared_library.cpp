// dlopen.
#include "render/gl/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "base/out_of_memory.h"

namespace billow::render {
namespace {

// The loader tells its reason in words alone, of memory not always the system's.
bool names_error(const std::string& reason, int error) {
  return reason.find(std::strerror(error)) != std::string::npos;
}

bool names_memory(const std::string& reason) {
  return names_error(reason, ENOMEM) || reason.find("failed to map segment") != std::string::npos ||
         reason.find("cannot map zero-fill pages") != std::string::npos ||
         reason.find("cannot change memory protections") != std::string::npos;
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& name, const std::string& packages)
    : name_(name), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_) return;
  const std::string reason = dlerror();
  if (names_memory(reason)) throw std::bad_alloc();
  if (names_error(reason, EMFILE) || names_error(reason, ENFILE)) throw ResourceError(reason);
  throw ResourceError(fmt::format("{}; install {}", reason, packages));
}

void* SharedLibrary::symbol(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (!found) throw ResourceError(fmt::format("{} has no {}", name_, name));
  return found;
}

}  // namespace billow::render
