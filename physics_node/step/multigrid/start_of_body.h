#pragma once
// With what displacements a body begins.

#include <span>
#include <string>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/step/plane.h"

namespace palpate::physics {

/// Of body.nodes(), as its `start` says, on the right side of floor and walls; EMPTY: none [m]. Where no balance is found, a remark says
/// how near it came.
/// @throws InputError: nothing holds a body that is to be balanced, and no plane lies below it
std::vector<Vec3> start_of_body(const BodySpec& spec, const Body& body, const Vec3& gravity,
                                std::span<const Plane> planes, std::vector<std::string>& remarks);

}  // namespace palpate::physics
