// palpate itself, as `palpate simulate` steps it: whole frames of a World, guard included.

#include <optional>

#include "bench/peers/solver.h"
#include "bench/problems/stopwatch.h"
#include "common/report/commit.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

struct Way {
  const char* name;
  Integrator integrator;
  bool half_step_back;  // velocities start at t = -dt / 2
  Scheme scheme;
};

/// v(-dt/2) = -g dt/2 makes symplectic Euler the leapfrog scheme: at t = 0 every spring is at rest, so g is the
/// whole acceleration. Its positions are those of velocity Verlet.
void start_half_step_back(physics::BodyModel& body, const Vec3& gravity, double dt) {
  for (const physics::Index cell : body.body().lattice.masses)
    body.place(cell, Vec3::Zero(), -0.5 * dt * gravity);
}

class PalpateSolver final : public Solver {
 public:
  PalpateSolver(const Way& way, Precision precision, int threads) : way_(way), precision_(precision) {
    const bool single = precision == Precision::single_;
    method_ = {"palpate", way.name, single ? "single" : "double", threads, way.scheme, single ? 7.0 : 14.0,
               {},        1 << 30};
    if (threads == 1) method_.drop_steps = {2, 3, 4, 6, 8, 12, 16};
  }
  const Method& method() const override { return method_; }

  Run run(const Task& task) override {
    Scene scene = task.drop->scene;
    scene.physics->precision = precision_;
    scene.physics->threads = method_.threads;
    scene.physics->integrator = way_.integrator;
    scene.physics->step = task.dt();
    physics::World world(scene);
    if (way_.half_step_back) {
      start_half_step_back(world.body(0), scene.gravity, task.dt());
      world.restart_ledger();
    }
    const std::vector<std::optional<ToolState>> no_tools;
    const Stopwatch watch;
    for (int n = 0; n < task.frames; ++n) world.frame(no_tools);
    Run run{world.report().restored == 0, {}, watch.cpu_s(), watch.wall_s()};
    for (const physics::Index cell : world.body(0).body().lattice.masses)
      run.displacement.push_back(world.body(0).displacement(cell));
    return run;
  }

 private:
  Way way_;
  Precision precision_;
  Method method_;
};

constexpr Way euler = {"symplectic_euler", Integrator::symplectic_euler, false, Scheme::symplectic_euler};
constexpr Way leapfrog = {"symplectic_euler from -dt/2", Integrator::symplectic_euler, true,
                          Scheme::leapfrog};
constexpr Way verlet = {"velocity_verlet", Integrator::velocity_verlet, false, Scheme::leapfrog};

}  // namespace

std::unique_ptr<Solver> palpate_reference(Scheme scheme) {
  return std::make_unique<PalpateSolver>(scheme == Scheme::leapfrog ? leapfrog : euler, Precision::double_,
                                         1);
}

Peer palpate_peer() {
  Peer peer{"palpate",
            commit(),
            "",
            "Stores no spring and no neighbour: its bodies are lattices, a peer's may be anything. "
            "Steps whole frames of 1 ms, with the guard's look at the energy; renders and publishes nothing.",
            {}};
  for (const Way& way : {euler, verlet})
    for (const Precision precision : {Precision::single_, Precision::double_})
      for (const int threads : {1, 2})
        peer.solvers.push_back(std::make_unique<PalpateSolver>(way, precision, threads));
  return peer;
}

}  // namespace palpate::bench
