#pragma once
// What all that may touch does together, and so without effect on contact: a heap that flies is a heap that rests.

#include <vector>

#include "physics_node/collision/contact_body.h"

namespace palpate::physics {

/// The velocity against which all candidates of all bodies, as last read, are slow: the middle of the box round their velocities. For any
/// r no two move against each other faster than |v_a - r| + |v_b - r|.
/// @return zero where none is faster than `least`, and where not all are four times as slow against it as the fastest is: so wherever
///   anything rests or is held
Vec3 common_velocity(const std::vector<ContactBody>& bodies, double least) noexcept;

}  // namespace palpate::physics
