#pragma once
// What a body does as a whole, and so without effect on contact within it: a heap that flies is a heap that
// rests.

#include <vector>

#include "physics_node/collision/contact_body.h"

namespace palpate::physics {

/// The usual velocity (usual_motion.h) of all candidates of all bodies, as last read. @return zero where it
/// is not faster than `least`
Vec3 usual_velocity(const std::vector<ContactBody>& bodies, double least) noexcept;

/// The velocity against which nearly all candidates of a body, as last read, are slow: the usual one of
/// these. The few that have another one, held ones that a torn body has left behind, are fast against it.
/// @param against  usual_velocity(): all is told against this, so that it does not matter how fast all fly
///   together
/// @return `against` where it is not faster than `least` against that, and where not three of four are four
///   times as slow against it as the fastest is against that
Vec3 common_velocity(const ContactBody& body, const Vec3& against, double least) noexcept;

}  // namespace palpate::physics
