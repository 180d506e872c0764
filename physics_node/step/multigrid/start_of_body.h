#pragma once
// With what displacements a body begins.

#include <string>
#include <vector>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Of body.nodes(), as its `start` says; EMPTY: none [m]. Where no balance is found, a remark says how near it came.
/// @throws InputError: nothing holds a body that is to be balanced
std::vector<Vec3> start_of_body(const BodySpec& spec, const Body& body, const Vec3& gravity,
                                std::vector<std::string>& remarks);

}  // namespace palpate::physics
