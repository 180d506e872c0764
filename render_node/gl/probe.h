#pragma once
// Can this machine draw without a screen? For `palpate doctor`.

#include <string>

namespace palpate::render {

/// @param what  written: vendor, renderer and version, or the reason why not
/// @return whether a headless OpenGL 3.3 context could be made
bool probe_gl(std::string& what);

}  // namespace palpate::render
