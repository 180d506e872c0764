#pragma once
// From a mesh file and the materials of a scene to a body of tetrahedra.

#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// Fills mesh, law, laws and inverse_mass of a body whose shape is a mesh. The middle of the box round the file's nodes comes to the
/// body's `at`, turned by its orientation. A tetrahedron is of the last region that holds its centre or has its group, else of the body's own
/// material. Nothing is held yet.
/// @throws InputError: a file that cannot be read, a face of more than two tetrahedra, a region that holds nothing, materials whose
///   viscosity over modulus differs
void build_mesh_body(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials);

}  // namespace palpate::physics
