#include "render_node/gl/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <thread>

#include "common/error/error.h"

namespace palpate::render {
namespace {

constexpr EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                  EGL_NONE};
constexpr EGLint context_wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   3,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   3,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
constexpr EGLint pbuffer_wish[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};

std::string failure(const char* what) {
  return fmt::format("{} failed, EGL error {:#x}", what, eglGetError());
}

// Displays in the order of preference: one that needs no window system, then whatever the machine calls default.
std::array<EGLDisplay, 2> displays() {
  std::array<EGLDisplay, 2> found = {EGL_NO_DISPLAY, EGL_NO_DISPLAY};
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    found[0] = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  }
  found[1] = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  return found;
}

}  // namespace

EglContext::EglContext() {
  std::string reason = "libEGL.so.1 not found";
  if (epoxy_has_egl()) {
    reason = "no EGL display";
    for (EGLDisplay display : displays()) {
      if (display != EGL_NO_DISPLAY && open(display, reason)) return;
    }
  }
  throw InputError("cannot draw without a screen (" + reason +
                   "); install libegl1 and libgl1-mesa-dri, or a driver with OpenGL 3.3");
}

bool EglContext::open(void* display, std::string& reason) {
  if (!eglInitialize(display, nullptr, nullptr)) return reason = failure("eglInitialize"), false;
  EGLConfig config = nullptr;
  EGLint n = 0;
  if (!eglChooseConfig(display, config_wish, &config, 1, &n) || n < 1) {
    return reason = "EGL offers no OpenGL configuration", false;
  }
  if (!eglBindAPI(EGL_OPENGL_API)) return reason = failure("eglBindAPI"), false;
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish);
  if (context == EGL_NO_CONTEXT) return reason = failure("making an OpenGL 3.3 core context"), false;
  EGLSurface surface = EGL_NO_SURFACE;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    surface = eglCreatePbufferSurface(display, config, pbuffer_wish);
  }
  if (!eglMakeCurrent(display, surface, surface, context)) {
    reason = failure("eglMakeCurrent");
    eglDestroyContext(display, context);
    return false;
  }
  display_ = display;
  context_ = context;
  surface_ = surface;
  return true;
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
  eglDestroyContext(display_, context_);
  // No eglTerminate: the display is shared by all contexts of the process.
}

void EglContext::make_current() { eglMakeCurrent(display_, surface_, surface_, context_); }

std::string current_gl() {
  const auto text = [](GLenum name) {
    const GLubyte* value = glGetString(name);
    return value == nullptr ? std::string("?") : std::string(reinterpret_cast<const char*>(value));
  };
  return text(GL_VENDOR) + ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool software_gl() {
  const std::string what = current_gl();
  return what.find("llvmpipe") != std::string::npos || what.find("softpipe") != std::string::npos ||
         what.find("swrast") != std::string::npos;
}

bool few_cores() { return std::thread::hardware_concurrency() <= 2; }

}  // namespace palpate::render
