#pragma once
// The body that hexahedra are timed on: a cube of soft tissue (E 10 kPa, nu 0.45, 1000 kg/m^3, cells of 2.5 mm), bottom held, that
// moves gently, so that no number is denormal.

#include <memory>

#include "common/scene/element_kinds.h"
#include "common/scene/kinds.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

struct HexCubeKind {
  HourglassKind hourglass = HourglassKind::physical;
  Precision precision = Precision::single_;
  bool damped = true;
  bool relaxing = false;
  bool breaking = false;  // may, and does not
  bool yielding = false;  // may, and does not
  bool yielded = false;   // all cells have, and go on
  int cells = 40;         // along each side
  int threads = 1;
};

struct HexCube {
  std::unique_ptr<physics::BodyModel> body;
  double stable_step = 0;  // near rest, as it is damped [s]

  /// Steps of half of it; one of four is watched for the books, as in a frame of four steps.
  void step(int n_steps, physics::Team* team, int threads);
};

HexCube make_hex_cube(const HexCubeKind& kind);

}  // namespace palpate::bench
