#pragma once
// From the materials of a scene to the finite elements of a voxel body.

#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// Fills body.solid. Each deformable cell is of the material that its centre lies in.
/// @throws InputError: regions whose poisson_ratio or viscosity / modulus differs from the body's own
void give_solid_elements(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials);

}  // namespace palpate::physics
