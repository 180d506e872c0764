#include "bench/solids/resting_beam.h"

#include <algorithm>
#include <memory>

#include "bench/problems/hex_beam.h"
#include "bench/problems/stopwatch.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::bench {
namespace {

physics::Body beam_body(ElementModel model, HourglassKind hourglass, int cells, double poisson_ratio) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = HexBeam::modulus;
  tissue.density = HexBeam::density;
  if (model == ElementModel::fem) tissue.poisson_ratio = poisson_ratio;
  BodySpec spec;
  spec.name = "beam";
  spec.lattice = LatticeKind::voxel;
  spec.model = model;
  spec.hourglass = hourglass;
  spec.spacing = HexBeam::height / cells;
  spec.material = "tissue";
  spec.shape = BoxShape{{HexBeam::length, HexBeam::height, HexBeam::height}};
  spec.fixed_faces[0] = true;  // -x
  return physics::build_body(spec, tissue);
}

class Stepped final : public BeamStepper {
 public:
  explicit Stepped(physics::Body body)
      : dt_(beam_step_share *
            physics::stable_step(physics::stiffest_mode(body), Integrator::symplectic_euler)),
        model_(physics::make_body_model(std::move(body), Precision::double_)) {}
  void step() override {
    model_->advance({.dt = dt_, .gravity = Vec3(0, 0, -RestingBeam::gravity), .watch = true}, {});
  }
  double kinetic() const override { return model_->watch().kinetic; }
  void stop() override {
    for (const physics::Index node : model_->body().nodes())
      model_->place(node, model_->displacement(node), Vec3::Zero());
  }
  const physics::BodyModel& model() const { return *model_; }

 private:
  double dt_;
  std::unique_ptr<physics::BodyModel> model_;
};

}  // namespace

bool settle(BeamStepper& beam, double enough, std::int64_t& steps) {
  constexpr std::int64_t most = 20000;
  double before = 0, largest = 0;
  for (steps = 0; steps < most;) {
    beam.step();
    ++steps;
    const double now = beam.kinetic();
    if (now < before) {
      if (before < enough * largest) return true;
      beam.stop();
      before = 0;
    } else {
      before = now;
      largest = std::max(largest, now);
    }
  }
  return false;
}

RestingBeam rest_beam(ElementModel model, HourglassKind hourglass, int cells, double poisson_ratio) {
  Stepped beam(beam_body(model, hourglass, cells, poisson_ratio));
  RestingBeam result{.cells = cells};
  const Stopwatch watch;
  result.at_rest = settle(beam, 1e-8, result.steps);
  result.cpu_s = watch.cpu_s();
  const physics::Body& body = beam.model().body();
  result.elements = beam.model().counts().elements;
  double far = 0, n = 0;
  for (const physics::Index node : body.nodes()) far = std::max(far, body.rest_position(node).x());
  for (const physics::Index node : body.nodes()) {
    if (body.rest_position(node).x() < far - 1e-6) continue;
    result.sunk -= beam.model().displacement(node).z() / RestingBeam::gravity;
    n += 1;
  }
  result.sunk /= n;
  return result;
}

}  // namespace palpate::bench
