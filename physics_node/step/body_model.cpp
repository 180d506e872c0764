#include "physics_node/step/body_model.h"

#include <utility>

#include "common/error/error.h"
#include "physics_node/step/fem/tet_body.h"
#include "physics_node/step/lattice/lattice_body.h"
#include "physics_node/step/surface_mesh/surface_body.h"

namespace palpate::physics {

std::unique_ptr<BodyModel> make_body_model(Body body, Precision precision, Integrator integrator,
                                           std::vector<Vec3> start) {
  if (!body.mesh) return make_lattice_body(std::move(body), precision, integrator, std::move(start));
  PALPATE_CHECK(integrator == Integrator::symplectic_euler, "the reader refuses others");
  if (body.mesh->springs) return make_surface_body(std::move(body), precision, std::move(start));
  return make_tet_body(std::move(body), precision, std::move(start));
}

}  // namespace palpate::physics
