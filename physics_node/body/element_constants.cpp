#include "physics_node/body/element_constants.h"

#include <algorithm>
#include <limits>

namespace palpate::physics {

ElementConstants element_constants(const ElementLaw& a, const ElementLaw& b, std::size_t half_direction) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::size_t d = half_direction;
  ElementConstants e;
  e.k1 = 0.5 * (a.k1[d] + b.k1[d]);
  e.k2 = 0.5 * (a.k1[d] * a.k2_ratio + b.k1[d] * b.k2_ratio);
  e.c = 0.5 * (a.c[d] + b.c[d]);
  e.y_p = std::min(a.yields ? a.y_p : never, b.yields ? b.y_p : never);
  e.b_p = std::min(a.yields ? a.b_p : never, b.yields ? b.b_p : never);
  return e;
}

ElementConstants element_constants(const Body& body, Index i, Index j, std::size_t half_direction) {
  return element_constants(law_at(body, i), law_at(body, j), half_direction);
}

}  // namespace palpate::physics
