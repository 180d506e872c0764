#pragma once
// A body that moves: one object with four faces. Whoever uses it takes the face it needs.

#include <memory>
#include <vector>

#include "common/scene/kinds.h"
#include "physics_node/step/books.h"
#include "physics_node/step/node_motion.h"
#include "physics_node/step/pending_step.h"
#include "physics_node/step/stepper.h"
#include "physics_node/step/topology.h"

namespace palpate::physics {

class BodyModel : public Stepper, public NodeMotion, public Books, public Topology {
 public:
  using NodeMotion::body;
  /// Its step in parts, for bodies that touch; null: it is not of backward_euler.
  virtual PendingStep* pending() noexcept = 0;

 protected:
  explicit BodyModel(const Body& body) : NodeMotion(body), Topology(body) {}
};
using BodyModels = std::vector<std::unique_ptr<BodyModel>>;

/// Of whatever kind the body is; a mesh is stepped by symplectic Euler only.
/// @param start  displacements of body.nodes() that it begins with, and comes back to when it is reset; EMPTY: none [m]
std::unique_ptr<BodyModel> make_body_model(Body body, Precision precision,
                                           Integrator integrator = Integrator::symplectic_euler,
                                           std::vector<Vec3> start = {});

}  // namespace palpate::physics
