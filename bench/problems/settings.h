#pragma once
// How a reference problem is to be solved, what that gave, and scenes without a file.

#include <cstdint>
#include <functional>
#include <string>

#include "common/math/vec3.h"
#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/world.h"

namespace palpate::bench {

struct Settings {
  Integrator integrator = Integrator::symplectic_euler;
  Precision precision = Precision::double_;
  double step = 0;  // [s]
  int threads = 1;
};

struct Outcome {
  double error = 0;  // relative; each problem says to what
  double cpu_s = 0;  // of all threads, stepping only
  std::int64_t steps = 0;
  std::int64_t masses = 0;
};

const char* name_of(Integrator integrator);
const char* name_of(Precision precision);

/// A scene without weight, bodies and sleep: one material "m" of mass and spring constant 1 to be changed.
Scene empty_scene();

/// A face-centred lattice from the point `at` on, `size` long; neighbours `spacing` apart; of material "m".
BodySpec box_body(LatticeKind lattice, const Vec3& size, double spacing);

/// Two masses of 1 kg, 1 m apart along pair_axis(), k1 = 1000 N/m. The first is held.
Scene pair_scene();
Vec3 pair_axis();
/// The free one's storage cell.
physics::Index free_mass(const physics::World& world);

/// Divides `seconds` into `frames` frames of whole steps, none longer than settings.step.
void apply(const Settings& settings, double seconds, int frames, Scene& scene);

/// Runs frames and measures their CPU time. After each it calls look(frame number from 1), if there is one, off the clock.
Outcome run(physics::World& world, int frames, const std::function<void(int)>& look = {});

}  // namespace palpate::bench
