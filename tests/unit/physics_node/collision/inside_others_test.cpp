// What lies inside another body, against bodies whose inside is known in closed form.
#include "physics_node/collision/inside_others.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/report/physics_summary.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

std::unique_ptr<BodyModel> moving(const Recipe& recipe) {
  return make_body_model(body_of(recipe), Precision::double_);
}

/// Volume of all that a body fills [m^3].
double filled_volume(const BodyModel& body) {
  const Lattice& lattice = body.body().lattice;
  const auto patterns = volume_patterns(lattice);
  const auto mask = [&](Index cell) { return body.adjacency().live_elements(cell); };
  double sum = 0;
  for (const Index cell : lattice.masses)
    for (const VolumePattern& volume : patterns[static_cast<std::size_t>(lattice.row_kind(cell))]) {
      if (!is_filled(volume, lattice, cell, mask)) continue;
      for (const auto& t : volume.tetrahedra) {
        std::array<Vec3, 4> x;
        for (std::size_t c = 0; c < 4; ++c) x[c] = body.position(cell + volume.corner[t[c]]);
        sum += std::abs((x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]))) / 6;
      }
    }
  return sum;
}

constexpr double step = 0.01;  // of the cubic grid [m]

/// A cube of (0.04 m)^3 from 0 to 0.04 m each way, whose faces are layers of masses.
Recipe cube(const char* lattice) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.spacing_mm = std::string(lattice) == "fcc" ? 1e3 * step * std::sqrt(2.0) : 1e3 * step;
  recipe.shape = Recipe::box(40, 40, 40);
  recipe.body = "at_mm = [20, 20, 20]";
  return recipe;
}

TEST(Volumes, FillABox) {
  EXPECT_NEAR(filled_volume(*moving(cube("voxel"))), std::pow(0.04, 3), 1e-12);
  // On each of the twelve edges lie two octahedral sites of whose octahedron, (4/3) step^3, a quarter would belong to the cube.
  const double missing = 12 * 2 * 0.25 * 4.0 / 3 * std::pow(step, 3);
  EXPECT_NEAR(filled_volume(*moving(cube("fcc"))), std::pow(0.04, 3) - missing, 1e-12);
}

class OfEachLattice : public testing::TestWithParam<const char*> {
 protected:
  OfEachLattice() {
    Recipe ball;  // in a lattice of its own, so that no mass lies on a face of the cube
    ball.shape = Recipe::sphere(18);
    ball.spacing_mm = 4.3;
    ball.body = "at_mm = [12.3, 20.2, 19.7]";
    bodies.push_back(moving(cube(GetParam())));
    bodies.push_back(moving(ball));
  }

  /// Masses of the ball in the cube, which affine `map` has moved, away from its edges, which fcc leaves open.
  Index expected(const Eigen::Affine3d& map) const {
    Index n = 0;
    for (const Index cell : bodies[1]->body().lattice.masses) {
      const Vec3 p = map.inverse() * bodies[1]->position(cell);
      n += (p.array() > 0).all() && (p.array() < 0.04).all() ? 1 : 0;
    }
    return n;
  }
  void move_cube(const Eigen::Affine3d& map) {
    for (const Index cell : bodies[0]->body().lattice.masses) {
      const Vec3 rest = bodies[0]->body().lattice.rest_position(cell);
      bodies[0]->place(cell, map * rest - rest, Vec3::Zero());
    }
  }

  std::vector<std::unique_ptr<BodyModel>> bodies;
};

TEST_P(OfEachLattice, AreTheMassesBetweenItsFaces) {
  InsideOthers inside(bodies);
  inside.look();
  ASSERT_GT(expected(Eigen::Affine3d::Identity()), 100);
  EXPECT_EQ(inside.now(1), expected(Eigen::Affine3d::Identity()));
  EXPECT_GT(inside.now(0), 0) << "masses of the cube are in the ball, too";
}

TEST_P(OfEachLattice, FollowTheBodyAsItIsNow) {
  InsideOthers inside(bodies);
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() << 1, 0.4, 0, 0, 1.1, 0.2, -0.1, 0, 0.9;
  map.translation() = Vec3(0.002, -0.004, 0.003);
  move_cube(map);
  inside.look();
  ASSERT_GT(expected(map), 50);
  EXPECT_NE(expected(map), expected(Eigen::Affine3d::Identity()));
  // An edge of the fcc cube lacks quarters of octahedra: 56 of its 64 cm^3 are filled.
  EXPECT_LE(inside.now(1), expected(map));
  EXPECT_GE(inside.now(1), std::string(GetParam()) == "fcc" ? expected(map) - 8 : expected(map));
  const Index then = inside.now(1);
  map.translation().x() += 0.2;
  move_cube(map);
  inside.look();
  EXPECT_EQ(inside.now(1), 0);
  EXPECT_EQ(inside.now(0), 0);
  EXPECT_GE(inside.most(1), then);
  inside.restart();
  EXPECT_EQ(inside.most(1), 0);
  map.translation().x() = std::nan("");
  move_cube(map);
  inside.look();
  EXPECT_EQ(inside.now(1), 0) << "what is nowhere holds nothing";
}
INSTANTIATE_TEST_SUITE_P(Lattices, OfEachLattice, testing::Values("fcc", "voxel"));

TEST(InsideOthers, FindsNothingInWhatHasBrokenOpen) {
  Recipe brittle = cube("fcc");
  brittle.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.02";
  Recipe ball;
  ball.shape = Recipe::sphere(12);
  ball.spacing_mm = 4.3;
  ball.body = "at_mm = [20, 20, 20]";
  std::vector<std::unique_ptr<BodyModel>> bodies;
  bodies.push_back(moving(brittle));
  bodies.push_back(moving(ball));
  InsideOthers inside(bodies);
  inside.look();
  EXPECT_EQ(inside.now(1), bodies[1]->body().lattice.n_masses());
  for (const Index cell : bodies[0]->body().lattice.masses) {
    const Vec3 rest = bodies[0]->body().lattice.rest_position(cell);
    bodies[0]->place(cell, 0.1 * rest, Vec3::Zero());
  }
  bodies[0]->advance({.dt = 0}, {});
  ASSERT_EQ(bodies[0]->counts().live_elements, 0);
  inside.look();
  EXPECT_EQ(inside.now(1), 0);
}

TEST(InsideOthers, AreNotThoseOfBodiesThatAreFlush) {
  for (const char* lattice : {"fcc", "voxel"}) {
    Recipe upper = cube(lattice);
    upper.body = "at_mm = [20, 20, 60]";
    std::vector<std::unique_ptr<BodyModel>> bodies;
    bodies.push_back(moving(cube(lattice)));
    bodies.push_back(moving(upper));
    InsideOthers inside(bodies);
    inside.look();
    EXPECT_EQ(inside.now(0) + inside.now(1), 0) << lattice;
  }
}

/// A ball that flies through the middle of a cube, or not.
World shot(const char* distance, double seconds) {
  Recipe recipe = cube("fcc");
  recipe.material = "mass_g = 1\nk1_N_per_m = 2000\nviscosity_N_s_per_m = 0.2";
  recipe.world = "[contact]\ndistance = \"" + std::string(distance) +
                 "\"\n[[body]]\nname = \"ball\"\nspacing_mm = 10\nmaterial = \"m\"\nat_mm = [20, 20, 75]\n"
                 "velocity_m_per_s = [0, 0, -6]\n" +
                 Recipe::sphere(20);
  World world(scene_of(recipe));
  while (world.t() < seconds) world.frame({});
  return world;
}

TEST(InsideOthers, AreCountedWhileAWorldRunsAndWarnedOf) {
  const World through = shot("paper", 0.03);
  ASSERT_NE(through.inside_others(), nullptr);
  EXPECT_GT(through.inside_others()->most(1), 5);
  const auto summary = physics_summary(through, nullptr, 1);
  EXPECT_EQ(summary.at("bodies").at("ball").at("inside_others_max"), through.inside_others()->most(1));
  ASSERT_EQ(summary.at("warnings").size(), 1u) << summary.at("warnings");
  EXPECT_NE(summary.at("warnings")[0].get<std::string>().find("contact.distance = \"swept\""),
            std::string::npos);

  const World apart = shot("swept", 0.03);
  const auto sound = physics_summary(apart, nullptr, 1);
  EXPECT_EQ(sound.at("bodies").at("ball").at("inside_others"), 0);
  EXPECT_EQ(sound.at("bodies").at("ball").at("inside_others_max"), 0);
  EXPECT_TRUE(sound.at("warnings").empty()) << sound.at("warnings");
}

TEST(InsideOthers, AreNotAskedForWhereThereIsOneBody) {
  const World world(scene_of(cube("voxel")));
  EXPECT_FALSE(physics_summary(world, nullptr, 1).at("bodies").at("body").contains("inside_others"));
}

}  // namespace
}  // namespace palpate::physics
