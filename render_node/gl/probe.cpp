#include "render_node/gl/probe.h"

#include "common/error/error.h"
#include "render_node/gl/egl_context.h"

namespace palpate::render {

bool probe_gl(std::string& what) {
  try {
    const EglContext context;
    what = current_gl();
    return true;
  } catch (const InputError& error) {
    what = error.what();
    return false;
  }
}

}  // namespace palpate::render
