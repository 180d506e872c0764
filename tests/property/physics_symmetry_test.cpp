// What falls straight onto a body comes back straight, without friction: nothing in how surfaces are cut into facets, and in which order
// bodies and pairs are, may push it aside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

constexpr double fallen = 3;      // [mm]
constexpr double seconds = 0.05;  // the cube has touched, and parted again

struct Drop {
  const char *name, *model;   // of both bodies
  double slab_mm;             // 30: masses over masses; 27.5: over the middles of cells
  double x_mm = 0, y_mm = 0;  // of the cube
  bool cube_first = false;
  const char* restitution = "1";
};
void PrintTo(const Drop& drop, std::ostream* out) { *out << drop.name; }

Scene scene_of(const Drop& drop) {
  const auto body = [&](const char* name, const std::string& size, const std::string& at, double density,
                        double modulus) {
    return fmt::format(
        "[[body]]\nname = \"{0}\"\nlattice = \"voxel\"\nmodel = \"{1}\"\nshape = \"box\"\nsize_mm = {2}\n"
        "spacing_mm = 2.5\nat_mm = {3}\nmaterial = \"{0}\"\n\n[material.{0}]\ndensity_kg_per_m3 = {4}\n"
        "modulus_kPa = {5}\nviscosity_Pa_s = 20\n{6}\n",
        name, drop.model, size, at, density, modulus,
        drop.model == std::string("fem") ? "poisson_ratio = 0.45\n" : "");
  };
  const std::string slab = body("slab", fmt::format("[{0}, {0}, 15]", drop.slab_mm), "[0, 0, 7.5]", 1000, 20);
  const std::string cube =
      body("cube", "[20, 20, 20]", fmt::format("[{}, {}, {}]", drop.x_mm, drop.y_mm, 25 + fallen), 2000, 50);
  return parse_scene(
      "gravity_m_per_s2 = [0, 0, -9.81]\n[scene]\nseconds = 1\n[floor]\nheight_mm = 0\n[contact]\n"
      "restitution = " +
          std::string(drop.restitution) + "\n\n" + (drop.cube_first ? cube + slab : slab + cube),
      "test.toml");
}

/// Mean velocity of the cube when it has parted from the slab after the first touch, and its speed when it came [m/s].
struct Parting {
  Vec3 v = Vec3::Zero();
  double impact = 0;
};
Parting parts_with(const Drop& drop) {
  World world(scene_of(drop));
  const BodyModel& cube = world.body(drop.cube_first ? 0 : 1);
  double fastest_up = -1, fastest_down = 0;
  const auto mean = [&] {
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    for (const Index node : cube.body().nodes()) {
      momentum += node_mass(cube.body(), node) * cube.velocity(node);
      mass += node_mass(cube.body(), node);
    }
    return Vec3(momentum / mass);
  };
  while (world.t() < seconds) {
    world.frame({});
    fastest_up = std::max(fastest_up, mean().z());
    fastest_down = std::max(fastest_down, -mean().z());
  }
  EXPECT_GT(world.collisions()->tally().collisions, 1000) << "it has touched";
  EXPECT_GT(fastest_up, 0.3 * fastest_down) << "it has come back";
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  return {mean(), fastest_down};
}

class SymmetricDrop : public testing::TestWithParam<Drop> {};

TEST_P(SymmetricDrop, GoesUpAgainStraight) {
  const auto [v, impact] = parts_with(GetParam());
  const double aside = std::hypot(v.x(), v.y());
  fmt::print("{}: {:.2f} % of the speed of the impact aside\n", GetParam().name, 100 * aside / impact);
  EXPECT_LT(aside, 0.01 * impact);
}
INSTANTIATE_TEST_SUITE_P(All, SymmetricDrop,
                         testing::Values(Drop{"fem", "fem", 30}, Drop{"springs", "springs", 30},
                                         Drop{"fem_half_a_cell_off", "fem", 27.5},
                                         Drop{"springs_half_a_cell_off", "springs", 27.5},
                                         Drop{"fem_cube_first", "fem", 30, 0, 0, true},
                                         Drop{"springs_cube_first", "springs", 30, 0, 0, true},
                                         Drop{"fem_restitution_0", "fem", 30, 0, 0, false, "0"}),
                         [](const auto& drop) { return std::string(drop.param.name); });

/// Beside the middle it is pushed aside. Mirrored, it is pushed to the other side as much.
TEST(MirroredDrop, IsTheMirroredDrop) {
  for (const char* model : {"fem", "springs"}) {
    const auto [one, impact] = parts_with({"one", model, 30, 0.7, 0.3});
    const Vec3 in_x = parts_with({"in x", model, 30, -0.7, 0.3}).v;
    const Vec3 in_y = parts_with({"in y", model, 30, 0.7, -0.3}).v;
    const Vec3 swapped = parts_with({"swapped", model, 30, 0.3, 0.7}).v;
    fmt::print("{}: {:.2f} {:.2f}; in x {:.2f} {:.2f}; in y {:.2f} {:.2f}; swapped {:.2f} {:.2f} mm/s\n",
               model, 1e3 * one.x(), 1e3 * one.y(), 1e3 * in_x.x(), 1e3 * in_x.y(), 1e3 * in_y.x(),
               1e3 * in_y.y(), 1e3 * swapped.x(), 1e3 * swapped.y());
    const double near = 0.01 * impact;
    EXPECT_LT(std::hypot(one.x() + in_x.x(), one.y() - in_x.y()), near) << model;
    EXPECT_LT(std::hypot(one.x() - in_y.x(), one.y() + in_y.y()), near) << model;
    EXPECT_LT(std::hypot(one.x() - swapped.y(), one.y() - swapped.x()), near) << model;
  }
}

}  // namespace
}  // namespace palpate::physics
