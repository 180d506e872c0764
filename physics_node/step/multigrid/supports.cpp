#include "physics_node/step/multigrid/supports.h"

namespace palpate::physics {

void Supports::carry_up(const Supports& fine, const ShareTable& up, const GridPlane& plane) noexcept {
  constexpr float whole = 1 - 1e-6F;
  for (Index i = plane.first; i < plane.last; ++i) {
    PlaneSet any = 0;
    for (const NodeShare& from : up.of(i)) any |= fine.of_[static_cast<std::size_t>(from.node)];
    PlaneSet held = 0;
    for (PlaneSet bit = 1; any != 0; any &= ~bit, bit <<= 1) {
      if ((any & bit) == 0) continue;
      float share = 0;
      for (const NodeShare& from : up.of(i))
        if ((fine.of_[static_cast<std::size_t>(from.node)] & bit) != 0) share += from.share;
      if (share >= whole) held |= bit;
    }
    of_[static_cast<std::size_t>(i)] = held;
  }
}

}  // namespace palpate::physics
