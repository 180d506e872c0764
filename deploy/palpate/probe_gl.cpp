#include "deploy/palpate/probe_gl.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace palpate::deploy {
namespace {

// Why: the four calls by hand rather than through EGL's headers, which belong to the render node, and by dlopen, so that
// this program starts, and can say so, where EGL is missing. Names and numbers: EGL 1.5, EGL_MESA_platform_surfaceless.
using GetPlatformDisplay = void* (*)(unsigned platform, void* native, const std::intptr_t* attributes);
using Initialize = unsigned (*)(void* display, int* major, int* minor);
using QueryString = const char* (*)(void* display, int name);
using Terminate = unsigned (*)(void* display);
constexpr unsigned platform_surfaceless = 0x31DD;
constexpr int vendor_name = 0x3053;

template <class Function>
Function find(void* library, const char* name) {
  return reinterpret_cast<Function>(dlsym(library, name));
}

bool ask(void* library, std::string& what) {
  const auto get_display = find<GetPlatformDisplay>(library, "eglGetPlatformDisplay");
  const auto initialize = find<Initialize>(library, "eglInitialize");
  const auto query = find<QueryString>(library, "eglQueryString");
  const auto terminate = find<Terminate>(library, "eglTerminate");
  if (get_display == nullptr || initialize == nullptr || query == nullptr || terminate == nullptr) {
    what = "libEGL is older than 1.5; install the package libegl1";
    return false;
  }
  void* display = get_display(platform_surfaceless, nullptr, nullptr);
  int major = 0;
  int minor = 0;
  if (display == nullptr || initialize(display, &major, &minor) == 0) {
    what = "EGL gives no display without a screen; install the package libgl1-mesa-dri";
    return false;
  }
  const char* vendor = query(display, vendor_name);
  what = fmt::format("EGL {}.{} without a screen, {}", major, minor,
                     vendor == nullptr ? "unknown vendor" : vendor);
  terminate(display);
  return true;
}

}  // namespace

bool probe_gl(std::string& what) {
  void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    what = "no libEGL.so.1; install the package libegl1";
    return false;
  }
  return ask(library, what);  // the library stays: drivers do not survive being unloaded
}

}  // namespace palpate::deploy
