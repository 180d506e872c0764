#pragma once
// OpenGL 3.3 core without a screen: an EGL context that draws into framebuffers of its own only.
// Mesa's software renderer is enough.

#include <string>

namespace palpate::render {

class EglContext {
 public:
  /// Makes the context and makes it current.
  /// @throws InputError, one line with the reason and what to install
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current();

 private:
  bool open(void* display, std::string& reason);

  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;  // none where EGL can do without
};

/// Vendor, renderer and version of the current context.
std::string current_gl();

/// Does the processor do the drawing of the current context?
bool software_gl();

/// Do hand and tissue want all cores of this machine?
bool few_cores();

}  // namespace palpate::render
