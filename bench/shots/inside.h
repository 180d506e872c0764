#pragma once
// Which masses of one body are inside another, by counting how often a ray meets its surface. Knows nothing of contact.

#include <span>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::bench {

/// Masses that space reaches.
std::vector<physics::Index> surface_of(const physics::BodyModel& body);

/// How many of these masses of `inner` are inside the closed surface of `outer`. A ray may graze an edge: of three the
/// majority decides.
int count_inside(const physics::BodyModel& inner, std::span<const physics::Index> masses,
                 const physics::BodyModel& outer);

}  // namespace palpate::bench
