#pragma once
// Whose momentum can be known from what is booked.

#include <algorithm>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Of a body that nothing holds and nothing drags, whose dampers act along elements.
inline bool keeps_momentum(const Body& body) {
  return !is_anchored(body) && body.handle.empty() &&
         std::all_of(body.laws.begin(), body.laws.end(), [](const ElementLaw& law) {
           return law.drag == 0 && (!law.damped || law.damper == Damper::axial);
         });
}

}  // namespace palpate::physics
