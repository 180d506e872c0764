#include "physics_node/step/surface_mesh/surface_body.h"

#include <utility>

#include "physics_node/step/mesh_body_model.h"
#include "physics_node/step/surface_mesh/surface_springs.h"

namespace palpate::physics {
namespace {

template <class Real>
std::unique_ptr<BodyModel> make_springs(Body body, std::vector<Vec3> start) {
  SurfaceSprings<Real> springs(*body.mesh->springs, body.inverse_mass);
  return std::make_unique<MeshBodyModel<SurfaceSprings<Real>>>(std::move(body), std::move(start),
                                                               std::move(springs));
}

}  // namespace

std::unique_ptr<BodyModel> make_surface_body(Body body, Precision precision, std::vector<Vec3> start) {
  return precision == Precision::single_ ? make_springs<float>(std::move(body), std::move(start))
                                         : make_springs<double>(std::move(body), std::move(start));
}

}  // namespace palpate::physics
