#pragma once
// Does a record open in VTK?

#include <cstdint>
#include <cstdlib>
#include <string>

namespace palpate::physics::test {

/// @param steps  times that it must hold; 0: any number but none
/// @param more   "slab": it is the slab of pressed_world.h
inline bool opens_in_viewer(const std::string& xdmf, int steps, std::uint64_t points,
                            const std::string& more = "") {
  const char* source = std::getenv("PALPATE_SOURCE");
  const std::string script =
      std::string(source == nullptr ? "." : source) + "/tests/unit/physics_node/record/open_record.py";
  return std::system(("/usr/bin/python3 '" + script + "' '" + xdmf + "' " + std::to_string(steps) + " " +
                      std::to_string(points) + " " + more)
                         .c_str()) == 0;
}

}  // namespace palpate::physics::test
