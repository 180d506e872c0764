#pragma once
// Which mass of a body is of which material, and what follows: laws and masses.
//
//   fcc    a mass is of the last region that holds its rest position, or whose window holds the intensity of its cell of
//          the image, else of the body's own material.
//   voxel  a cell is of the last region that holds its centre, or whose window holds its intensity, else of the body's
//          own material. A mass is of what most of the deformable cells round it are of; where two have equally
//          many, of the later region.
//
// Masses of one material weigh the same, as in the papers; with a density they weigh together what the cells weigh
// that they share (voxel: an eighth of each cell at each of its corners).

#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// The material of this name, which must be there.
const MaterialSpec& named(const std::vector<MaterialSpec>& materials, const std::string& name);

/// Fills law, laws, law_of and inverse_mass of a body whose lattice and cells are there. Nothing is held yet.
/// @throws InputError: a region that holds nothing of the body
void give_materials(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials);

}  // namespace palpate::physics
