#pragma once
// A body on a lattice that moves: springs or hexahedra.

#include <memory>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// As make_body_model(), of a body that has a lattice.
std::unique_ptr<BodyModel> make_lattice_body(Body body, Precision precision, Integrator integrator,
                                             std::vector<Vec3> start);

}  // namespace palpate::physics
