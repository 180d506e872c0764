#pragma once
// A body of tetrahedra that moves, as the others know it.

#include <memory>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// As make_body_model(), of a body that is a mesh. It is stepped by symplectic Euler, never sleeps, and nothing of it breaks.
std::unique_ptr<BodyModel> make_tet_body(Body body, Precision precision, std::vector<Vec3> start);

}  // namespace palpate::physics
