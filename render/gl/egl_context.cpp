// EGL: contexts of a device, or of Mesa's software, that draw into no surface.
#define EGL_NO_PLATFORM_SPECIFIC_TYPES  // of any window system
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <new>
#include <string_view>

#include "base/out_of_memory.h"
#include "render/gl/native_context.h"
#include "render/gl/shared_library.h"

namespace billow::render {
namespace {

constexpr const char* egl_packages = "libegl1 libegl-mesa0 libgl1-mesa-dri";
constexpr EGLint most_devices = 64;

struct EglLibrary {
  SharedLibrary file{"libEGL.so.1", egl_packages};
#define BILLOW_EGL_FUNCTION(member, name) decltype(&name) member = file.function<decltype(&name)>(#name)
  BILLOW_EGL_FUNCTION(get_error, eglGetError);
  BILLOW_EGL_FUNCTION(query_string, eglQueryString);
  BILLOW_EGL_FUNCTION(initialize, eglInitialize);
  BILLOW_EGL_FUNCTION(bind_api, eglBindAPI);
  BILLOW_EGL_FUNCTION(create_context, eglCreateContext);
  BILLOW_EGL_FUNCTION(destroy_context, eglDestroyContext);
  BILLOW_EGL_FUNCTION(make_current, eglMakeCurrent);
  BILLOW_EGL_FUNCTION(get_proc_address, eglGetProcAddress);
#undef BILLOW_EGL_FUNCTION

  // Null where EGL does not have them.
  template <class Function>
  Function extension(const char* name) const {
    return reinterpret_cast<Function>(get_proc_address(name));
  }
  PFNEGLQUERYDEVICESEXTPROC query_devices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string =
      extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display =
      extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  PFNEGLGETDISPLAYDRIVERNAMEPROC driver_name = extension<PFNEGLGETDISPLAYDRIVERNAMEPROC>("eglGetDisplayDriverName");
};

const EglLibrary& egl() {
  static const EglLibrary library;
  return library;
}

// Extensions are words in a line.
bool has_extension(const char* list, std::string_view name) {
  return list && fmt::format(" {} ", list).find(fmt::format(" {} ", name)) != std::string::npos;
}

std::vector<EGLDeviceEXT> listed_devices() {
  EGLDeviceEXT devices[most_devices];
  EGLint count = 0;
  if (!egl().query_devices || !egl().query_devices(most_devices, devices, &count)) return {};
  return std::vector<EGLDeviceEXT>(devices, devices + count);  // braces would list the two pointers
}

std::string device_text(EGLDeviceEXT device) {
  const char* extensions = egl().query_device_string(device, EGL_EXTENSIONS);
  if (has_extension(extensions, "EGL_MESA_device_software")) return "software";
  const char* file = has_extension(extensions, "EGL_EXT_device_drm")
                         ? egl().query_device_string(device, EGL_DRM_DEVICE_FILE_EXT)
                         : nullptr;
  return file ? file : "a GPU";
}

std::string device_list(const std::vector<EGLDeviceEXT>& devices) {
  if (devices.empty()) return fmt::format("it lists no devices at all; install {}, or the GPU's driver", egl_packages);
  std::string list;
  for (std::size_t d = 0; d < devices.size(); ++d)
    list += fmt::format("{}egl:{} ({})", d == 0 ? "" : ", ", d, device_text(devices[d]));
  return "devices are " + list;
}

/// A display to make contexts of, and what messages call it.
struct EglDisplay {
  EGLDisplay display;
  std::string name;
};

EglDisplay display_of(EGLDeviceEXT device, const std::string& name) {
  return {egl().get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), name};
}

EglDisplay display_of_number(int number) {
  const std::vector<EGLDeviceEXT> devices = listed_devices();
  if (number >= static_cast<int>(devices.size()))
    throw ResourceError(fmt::format("EGL has no device {}; {}", number, device_list(devices)));
  return display_of(devices[static_cast<std::size_t>(number)], fmt::format("egl:{}", number));
}

// Of the device that says that it is software. Where none does, or it does not work, of Mesa's surfaceless platform,
// which the environment has been told to keep to software.
std::vector<EglDisplay> software_displays() {
  constexpr const char* name = "EGL's software";
  std::vector<EglDisplay> displays;
  for (const EGLDeviceEXT device : listed_devices())
    if (has_extension(egl().query_device_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
      displays.push_back(display_of(device, name));
  if (has_extension(egl().query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
    displays.push_back({egl().get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), name});
  if (displays.empty()) throw ResourceError(fmt::format("EGL has no software here; install {}", egl_packages));
  return displays;
}

// EGL says no more of a driver that does not fit into memory than of one that is missing: whether as much is there as
// Mesa's takes is tried.
void require_memory_for_driver() {
  constexpr std::size_t driver_size = std::size_t{256} << 20;
  void* const memory = mmap(nullptr, driver_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  munmap(memory, driver_size);
}

class EglContext : public NativeContext {
 public:
  explicit EglContext(const EglDisplay& display) : display_(display.display) {
    if (!display_ || !library_.initialize(display_, nullptr, nullptr)) {
      require_memory_for_driver();
      fail(display.name, "cannot be initialised");
    }
    const char* extensions = library_.query_string(display_, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
      if (!has_extension(extensions, needed)) fail(display.name, fmt::format("lacks {}", needed));
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    if (!library_.bind_api(EGL_OPENGL_API)) fail(display.name, "has no OpenGL");
    context_ = library_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!context_) fail(display.name, "makes no OpenGL 3.3 core context");
  }
  // The display stays: others may draw with it.
  ~EglContext() override { library_.destroy_context(display_, context_); }

  void make_current() override {
    if (!library_.bind_api(EGL_OPENGL_API) ||  // the thread's
        !library_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw std::runtime_error(
          fmt::format("the EGL context cannot be made current (error 0x{:04x})", library_.get_error()));
  }
  void release() override { library_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  Function function(const char* name) const override { return library_.get_proc_address(name); }
  std::string driver() const override {
    const char* name = library_.driver_name ? library_.driver_name(display_) : nullptr;
    return name ? name : "";
  }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw ResourceError(
        fmt::format("{} {} (error 0x{:04x}); check the driver, which Mesa has in libgl1-mesa-dri; with "
                    "EGL_LOG_LEVEL=debug in the environment EGL says more",
                    name, what, library_.get_error()));
  }

  const EglLibrary& library_ = egl();
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

// Of the first display that makes one.
std::unique_ptr<NativeContext> make_software_context() {
  const std::vector<EglDisplay> displays = software_displays();
  for (std::size_t d = 0; d + 1 < displays.size(); ++d) {
    try {
      return std::make_unique<EglContext>(displays[d]);
    } catch (const ResourceError&) {  // the last one says why
    }
  }
  return std::make_unique<EglContext>(displays.back());
}

void require_platforms() {
  if (!egl().get_platform_display ||
      !has_extension(egl().query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_base"))
    throw ResourceError(fmt::format("EGL has no driver that draws without a window; install {}", egl_packages));
}

}  // namespace

std::unique_ptr<NativeContext> make_egl_context(std::optional<int> device) {
  require_platforms();
  if (!device) return make_software_context();
  return std::make_unique<EglContext>(display_of_number(*device));
}

int egl_devices() {
  require_platforms();
  return static_cast<int>(listed_devices().size());
}

}  // namespace billow::render
