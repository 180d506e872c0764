#pragma once
// Can pictures be drawn here without a display?

#include <string>

namespace palpate::deploy {

/// @param what  written: the EGL version and vendor, or what is missing
/// @return true if EGL gives a surfaceless display
bool probe_gl(std::string& what);

}  // namespace palpate::deploy
