#pragma once
// What a body does as a whole, and so without effect on contact within it: a heap that flies is a heap that rests.

#include "physics_node/collision/contact_body.h"

namespace palpate::physics {

/// The velocity against which nearly all candidates of a body, as last read, are slow: the usual one (usual_motion.h). The few that have
/// another one, held ones that a torn body has left behind, are fast against it.
/// @return zero where it is not faster than `least`, and where not three of four are four times as slow against it as the fastest is
Vec3 common_velocity(const ContactBody& body, double least) noexcept;

}  // namespace palpate::physics
