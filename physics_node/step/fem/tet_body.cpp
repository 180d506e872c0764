#include "physics_node/step/fem/tet_body.h"

#include <utility>

#include "physics_node/step/fem/tetrahedra.h"
#include "physics_node/step/mesh_body_model.h"

namespace palpate::physics {
namespace {

template <class Real>
std::unique_ptr<BodyModel> make(Body body, std::vector<Vec3> start) {
  Tetrahedra<Real> tets(body.mesh->model, instruction_set(), body.mesh->most_copies());
  return std::make_unique<MeshBodyModel<Tetrahedra<Real>>>(std::move(body), std::move(start),
                                                           std::move(tets));
}

}  // namespace

std::unique_ptr<BodyModel> make_tet_body(Body body, Precision precision, std::vector<Vec3> start) {
  return precision == Precision::single_ ? make<float>(std::move(body), std::move(start))
                                         : make<double>(std::move(body), std::move(start));
}

}  // namespace palpate::physics
