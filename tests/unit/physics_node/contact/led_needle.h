#pragma once
// A needle that a hand leads a frame at a time, in a block of finite elements.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {

inline constexpr double toughness = 164, diameter = 0.0012, friction = 15,
                        ratio = 1.5;                     // [J/m^2], [m], [N/m]
inline constexpr double goes_on = toughness * diameter;  // [N]
inline constexpr double top = 0.015;                     // of the block [m]

struct Case {
  const char* model = "fem";
  double cell_mm = 2, speed = 0.05;
  const char* precision = "double";
  int modulus_kPa = 60;
};

inline std::string tool(double rubs = friction) {
  return fmt::format(
      "[[tool]]\nname = \"needle\"\nshape = \"needle\"\nrigid = true\nlength_mm = 60\ndiameter_mm = {}\n"
      "friction_N_per_m = {}\ndevice = \"hand\"\nstiffness_N_per_m = 1000\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 25], [1, 0, 0, 25]]\n",
      1e3 * diameter, rubs);
}

inline Recipe block(const Case& c = {}, const std::string& body = "fixed = [\"-z\", \"-x\", \"+x\"]") {
  Recipe recipe;
  if (c.model == std::string("fem")) {
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(30, 30, 30);
    recipe.spacing_mm = c.cell_mm;
    recipe.body = "model = \"fem\"\n";
  } else {
    const int n = static_cast<int>(std::lround(30 / c.cell_mm));
    recipe = mesh_box({n, n, n}, 1e-3 * c.cell_mm, "nodal_pressure");
  }
  recipe.body += "at_mm = [0, 0, 0]\n" + body;
  recipe.material = fmt::format(
      "density_kg_per_m3 = 1000\nmodulus_kPa = {}\npoisson_ratio = 0.45\nviscosity_Pa_s = 2\n"
      "cut_toughness_J_per_m2 = {}\n",
      c.modulus_kPa, toughness);
  recipe.physics = "frame_Hz = 1000";
  recipe.precision = c.precision;
  recipe.world = tool();
  return recipe;
}

inline const Vec3 above(0.0003, 0.0007, top + 0.003);
inline Vec3 at_depth(double depth) { return {above.x(), above.y(), top - depth}; }

struct Needle : LedBlade {
  explicit Needle(const Recipe& recipe, const Vec3& start = above) : LedBlade(recipe, start) {}
  /// Mean and greatest force on the hand along +z.
  struct Way {
    double mean = 0, most = -1e9, jump = 0;
  };
  Way way(const Vec3& end, double speed) {
    Way of;
    const std::vector<Vec3> forces = along(end, speed);
    for (std::size_t n = 0; n < forces.size(); ++n) {
      of.mean += forces[n].z() / static_cast<double>(forces.size());
      of.most = std::max(of.most, forces[n].z());
      if (n > 0) of.jump = std::max(of.jump, (forces[n] - forces[n - 1]).norm());
    }
    return of;
  }
  /// What the hand does on its way there [J].
  double work_to(const Vec3& end, double speed) {
    double work = 0;
    const Vec3 begin = path.back();
    const auto n = static_cast<int>(std::ceil((end - begin).norm() / speed * 1e3));
    for (int i = 1; i <= n; ++i) {
      const Vec3 before = path.back(), was = force, at = begin + (end - begin) * i / n;
      force = to(at);
      work -= 0.5 * (force + was).dot(at - before);
    }
    return work;
  }
  Vec3 force = Vec3::Zero();  // of the last frame of work_to()
};

}  // namespace palpate::physics::test
