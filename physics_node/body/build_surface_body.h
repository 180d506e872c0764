#pragma once
// From a file and a material of a scene to a closed surface of springs.

#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// Fills mesh, law, laws and inverse_mass of a body whose model is "surface": of a surface file its triangles, of a
/// mesh of tetrahedra the outer ones. The middle of the box round its nodes comes to the body's `at`, turned by its
/// orientation. Nothing is held yet.
/// @throws InputError: a file that cannot be read, or what check_surface() refuses
void build_surface_body(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials);

}  // namespace palpate::physics
