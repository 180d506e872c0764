#pragma once
// [floor] of a scene: the plane z = height that tissue stays above.

namespace palpate {

struct FloorSpec {
  double height = 0;  // [m]
};

}  // namespace palpate
