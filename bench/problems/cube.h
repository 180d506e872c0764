#pragma once
// The body that the kernels are timed on: a cube of soft tissue (E 10 kPa, 1000 kg/m^3, neighbours 5 mm apart), bottom
// held, that moves gently, so that no number is denormal and nothing sleeps.

#include <memory>
#include <string>

#include "common/scene/kinds.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

/// What the elements of the cube do.
enum class Work {
  undamped,  // elastic
  damped,    // elastic, with a damper
  plastic,   // may yield, but stays within its elastic range
  yielding   // every element is stretched further in every step, and yields
};
const char* name_of(Work work);

struct CubeKind {
  LatticeKind lattice = LatticeKind::fcc;
  Precision precision = Precision::single_;
  Work work = Work::undamped;
  double masses = 1000;  // about
  bool operator==(const CubeKind&) const = default;
};

struct Cube {
  std::unique_ptr<physics::BodyModel> body;
  double stable_step = 0;               // [s]
  double step = 0;                      // half of that [s]
  std::unique_ptr<physics::Team> team;  // made for the most threads that it was set moving for
};

Cube make_cube(const CubeKind& kind);

/// Moves it as it is to be found: speeds of about 1 cm/s, or a slow expansion where it is to yield, and some steps to
/// warm up.
void set_moving(const CubeKind& kind, Cube& cube, int threads);

/// All that a step of a body without contact does, without weight.
inline void step(Cube& cube, int threads) noexcept {
  cube.body->advance({.dt = cube.step, .team = cube.team.get(), .threads = threads}, {});
}

}  // namespace palpate::bench
