#pragma once
// One [[body]] as it stands after loading: never changes while stepping.

#include <optional>
#include <string>
#include <vector>

#include "physics_node/body/cells.h"
#include "physics_node/body/element_law.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

struct Body {
  std::string name;
  Lattice lattice;
  ElementLaw law;
  std::optional<Cells> cells;        // of a voxel body; an fcc body has none
  std::vector<double> inverse_mass;  // of each storage cell, 0: held or empty [1/kg]  (n_cells)
  Vec3 velocity = Vec3::Zero();      // at the start [m/s]
  Index n_held = 0;                  // masses that do not move
};

/// Builds a body's lattice, law and held masses. @throws InputError
Body build_body(const BodySpec& spec, const MaterialSpec& material);

}  // namespace palpate::physics
