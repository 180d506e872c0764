#pragma once
// Counts what contact should not let happen.

#include <span>

#include "physics_node/collision/contact_impulses.h"

namespace palpate::physics {

/// Masses that go through a facet in the step, with the impulses given.
/// @param pairs  (mass, facet)
std::int64_t count_passages(const std::vector<ContactBody>& bodies, std::span<const NearPair> pairs,
                            double dt, const ContactImpulses& impulses) noexcept;

}  // namespace palpate::physics
