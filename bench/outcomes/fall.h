#pragma once
// A sphere that falls on the floor: what becomes of it.

#include "common/scene/scene_fwd.h"
#include "physics_node/fragments/outcome.h"

namespace palpate::bench {

struct Fall {
  double y_p = 1.5;  // yield ratio
  double gap = 0.5;  // break ratio less yield ratio
  double speed = 1;  // at which it meets the floor [m/s]
};

struct FallResult {
  Fall fall;
  physics::OutcomeMeasures measures;
  physics::Outcome outcome = physics::Outcome::original;
  double balance_error = 0;   // of energy
  double momentum_error = 0;  // over what was put in
  std::int64_t restored = 0;  // times that the guard acted
};

/// The sphere of scenes/fall_*.toml: 1289 masses on fcc, R = 6 L; no gravity, so that there is one impact.
Scene fall_scene(const Fall& fall);

/// Takes a second of CPU time for a second of fall. Several may run at a time, in threads of their own.
FallResult run_fall(const Fall& fall, double seconds);

}  // namespace palpate::bench
