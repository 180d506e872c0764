#pragma once
// A closed surface of springs that moves, as the others know it.

#include <memory>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// As make_body_model(), of a body whose mesh is of springs.
std::unique_ptr<BodyModel> make_surface_body(Body body, Precision precision, std::vector<Vec3> start);

}  // namespace palpate::physics
