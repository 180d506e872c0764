#pragma once
// The block pressed by 4 mm twice in three seconds, for as long as a test may take.

#include <string>

#include "tests/system/block_scene.h"

namespace palpate::test {

inline std::string pressing_scene() {
  std::string waypoints = "[0, 0, 0, 24]";
  // In 3 s: pressed for half a second, and for one and a half.
  for (int begin = 0; begin < 1200; begin += 3)
    waypoints += fmt::format(
        ", [{0}.30, 0, 0, 24], [{0}.45, 0, 0, 16], [{0}.90, 0, 0, 16], [{0}.99, 0, 0, 24], [{1}.30, 0, 0, "
        "24],"
        " [{1}.45, 0, 0, 16], [{2}.90, 0, 0, 16], [{2}.99, 0, 0, 24]",
        begin, begin + 1, begin + 2);
  return block_scene(500, 8, waypoints);
}

}  // namespace palpate::test
