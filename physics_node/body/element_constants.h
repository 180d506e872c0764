#pragma once
// The constants of one element, whatever its two ends are made of.

#include "physics_node/body/body.h"

namespace palpate::physics {

struct ElementConstants {
  double k1 = 0, k2 = 0;  // [N/m]
  double c = 0;           // [N s/m]
  double y_p = 0;         // yield ratio; infinite where neither end yields
  double b_p = 0;         // break ratio; likewise
};

/// Between a mass of law a and one of law b:
///   k1, k2, c   the mean of the two
///   y_p, b_p    the smaller of the two: an interface fails at its weaker side. A law that does not yield counts as infinite.
/// Symmetric in a and b, to the bit.
ElementConstants element_constants(const ElementLaw& a, const ElementLaw& b, std::size_t half_direction);

/// Of the element between the masses in storage cells i and j, which need not be live.
ElementConstants element_constants(const Body& body, Index i, Index j, std::size_t half_direction);

}  // namespace palpate::physics
