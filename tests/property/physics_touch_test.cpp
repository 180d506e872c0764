// A rigid sphere that the hand presses into tissue, by the faces of its surface: Hertz, and the laws.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/solids/driven_body.h"
#include "bench/solids/shape_press.h"
#include "common/message/vec3.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/smooth_image.h"

namespace palpate::physics::test {
namespace {

constexpr double top = 0.010;  // [m]

Recipe block(double radius_mm, const std::string& viscosity = "\nviscosity_Pa_s = 2") {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(40, 40, 20);
  recipe.spacing_mm = 2.5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45" + viscosity;
  recipe.body = "model = \"fem\"\nfixed = [\"-z\"]";
  recipe.precision = "single";
  recipe.world = point_tool(radius_mm);
  return recipe;
}

Recipe springs(double radius_mm, const std::string& viscosity = "\nviscosity_Pa_s = 2") {
  Recipe recipe = block(radius_mm);
  recipe.body = "fixed = [\"-z\"]";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10" + viscosity;
  recipe.world.insert(recipe.world.find("device"), "contact = \"faces\"\n");
  return recipe;
}

/// A hand whose proxy is over `beside` on the upper face, and that feels a force.
class Hand {
 public:
  void frame(World& world, double force, const Vec3& beside = Vec3::Zero()) {
    ToolState state;
    state.tick = ++tick_;
    state.p_WT = state.proxy = array(Vec3(Vec3(0, 0, top) + beside));
    state.force_on_hand = state.force_now = {0, 0, force};
    state.engaged = 1;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
  }

 private:
  std::uint64_t tick_ = 0;
};

double depth_of(const World& world) { return dynamic_cast<const PointTool&>(world.tool(0)).depth(); }

/// Pressed until it rests. @return depth of the sphere [m]
double rest_depth(const Recipe& recipe, double force, const Vec3& beside, int frames = 1200) {
  World world(scene_of(recipe));
  Hand hand;
  for (int n = 0; n < frames; ++n) hand.frame(world, force, beside);
  EXPECT_EQ(world.report().restored, 0);
  return depth_of(world);
}

TEST(Touch, OfTwoRadiiIsNotTheSame) {
  const Vec3 beside(0.0004, 0.0007, 0);
  for (const bool fem : {true, false}) {
    const auto of = [&](double radius_mm) {
      Recipe recipe = fem ? block(radius_mm) : springs(radius_mm);
      recipe.spacing_mm = 5;
      return rest_depth(recipe, 0.1, beside);
    };
    const double small = of(3), large = of(5);
    std::printf("R = 3 and 5 mm in cells of 5 mm, 0.1 N: %.3f and %.3f mm deep\n", 1e3 * small, 1e3 * large);
    EXPECT_GT(small, 1.05 * large);
  }
}

/// On cells of a quarter of the radius.
TEST(Touch, HalfACellBesideIsHardlyAnother) {
  Recipe recipe = block(5);
  recipe.spacing_mm = 1.25;
  recipe.shape = Recipe::box(30, 30, 20);
  const double on_node = rest_depth(recipe, 0.02, Vec3::Zero(), 600);
  for (const Vec3& beside : {Vec3(0.000625, 0, 0), Vec3(0.000625, 0.000625, 0)}) {
    const double force = std::pow(on_node / rest_depth(recipe, 0.02, beside, 600), 1.5);  // F goes as d^1.5
    std::printf("%.3f mm deep, %.2f of a cell beside a node: force x %.4f\n", 1e3 * on_node,
                beside.norm() / 0.00125, force);
    EXPECT_NEAR(force, 1, 0.05);
  }
}

/// On cells of an eighth of the radius, from a twentieth to three twentieths of it deep: F = 4/3 E / (1 - nu^2) R^0.5 d^1.5.
TEST(Touch, OfASphereIsHertz) {
  constexpr double R = 0.005, nu = 0.45, modulus = bench::ShapePress::modulus / (1 - nu * nu);
  const auto hertz = [&](double d) { return 4.0 / 3 * modulus * std::sqrt(R * d) * d; };
  bench::ShapePress how{.shape = RigidShape::sphere(R), .edge = R / 8, .poisson_ratio = nu};
  for (const double d : {0.05, 0.1, 0.15}) how.forces.push_back(hertz(d * R));
  const bench::ShapePressed pressed = bench::press(how);
  EXPECT_TRUE(pressed.at_rest);
  const std::vector<double> depth = bench::depth_on_half_space(how, pressed);
  for (std::size_t n = 0; n < depth.size(); ++n) {
    const double radius = std::sqrt(pressed.area[n] / std::numbers::pi);
    std::printf(
        "d = %.3f R: force %.4f of Hertz's, radius of contact %.3f mm, %.3f by Hertz, samples %.2g d deep\n",
        depth[n] / R, how.forces[n] / hertz(depth[n]), 1e3 * radius, 1e3 * std::sqrt(R * depth[n]),
        pressed.overlap[n] / depth[n]);
    EXPECT_NEAR(how.forces[n] / hertz(depth[n]), 1, 0.05);
    EXPECT_NEAR(radius, std::sqrt(R * depth[n]), how.edge);
    EXPECT_LT(pressed.overlap[n], 0.02 * depth[n]);
  }
  const double exponent =
      std::log(how.forces.back() / how.forces.front()) / std::log(depth.back() / depth.front());
  std::printf("exponent %.3f\n", exponent);
  EXPECT_NEAR(exponent, 1.5, 0.1);
}

/// Slid by three cells under the same force, slowly: how the depth changes on the way.
/// An image of a half space that leans, pressed square to it: how the skin lies in the cells should not be felt. [m]
/// of depth
double depth_on_slope(double degrees, SkinKind skin, BorderCells border) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3 out(std::sin(angle), 0, std::cos(angle)), at(0.1, 0.2, 8.6);  // [mm]
  SmoothImage image;
  image.size = {36, 30, 24};
  image.phi = [=](const Vec3& p) { return (at - p).dot(out); };
  image.skin = skin;
  image.border = border;
  image.fixed = {false, false, false, false, true, false};
  bench::DrivenBody body(image.body(), Precision::single_);
  const Boundary surface(body.model(), 0.02);
  FacePress press(surface, body.model(), RigidShape::sphere(0.006));
  const ShapePose pose = pose_along(1e-3 * at, out);
  std::vector<std::uint32_t> near;
  for (std::uint32_t f = 0; f < surface.surface().facets.size(); ++f)
    if ((surface.settled_centroid(f) - pose.tip).norm() < 0.016) near.push_back(f);
  body.after_step = [&](double dt) {
    press.list(pose, near);
    press.press(pose, 0.2, dt);
    body.model().kick(press.forces(), dt);
  };
  EXPECT_TRUE(body.settle(1e-7, 20000));
  return press.depth();
}

TEST(Touch, OfASlopeIsThatOfAPlane) {
  const double flat = depth_on_slope(0, SkinKind::smooth, BorderCells::filled);
  for (const double degrees : {8.0, 17.0, 30.0}) {
    const double smooth = depth_on_slope(degrees, SkinKind::smooth, BorderCells::filled) / flat,
                 whole = depth_on_slope(degrees, SkinKind::smooth, BorderCells::whole) / flat,
                 bricks = depth_on_slope(degrees, SkinKind::bricks, BorderCells::whole) / flat;
    std::printf("leans by %4.1f degrees: depth of %.3f mm times %.3f; border cells whole %.3f; bricks %.3f\n",
                degrees, 1e3 * flat, smooth, whole, bricks);
    EXPECT_NEAR(smooth, 1, 0.05) << degrees;
    EXPECT_NEAR(whole, 1, 0.1) << degrees;
  }
}

/// Halves of facets that look away from the mean of those around them.
int flipped(const Boundary& surface, const NodeMotion& moving) {
  const auto& facets = surface.surface().facets;
  std::vector<Vec3> around(surface.surface().n_vertices(), Vec3::Zero());
  const auto halves = [&](std::uint32_t f, const auto& visit) {
    std::array<Vec3, 4> x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = surface.position(f, c, moving);
    visit(Vec3((x[1] - x[0]).cross(x[2] - x[0])));
    if (!surface.is_triangle(f)) visit(Vec3((x[2] - x[0]).cross(x[3] - x[0])));
  };
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    halves(f, [&](const Vec3& area) {
      for (const std::uint32_t v : facets[f]) around[v] += area;
    });
  int n = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    Vec3 mean = Vec3::Zero();
    for (const std::uint32_t v : facets[f]) mean += around[v];
    halves(f, [&](const Vec3& area) { n += area.dot(mean) <= 0 ? 1 : 0; });
  }
  return n;
}

/// However the skin lies in the cells, a finger that goes in by 8 mm folds no triangle of it.
TEST(Touch, FoldsNoTriangleOfASmoothSkin) {
  for (const double degrees : {8.0, 30.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3 out(std::sin(angle), 0, std::cos(angle)), at(0.1, 0.2, 8.6);  // [mm]
    SmoothImage image;
    image.size = {36, 30, 24};
    image.phi = [=](const Vec3& p) { return (at - p).dot(out); };
    image.border = BorderCells::filled;
    image.fixed = {false, false, false, false, true, false};
    bench::DrivenBody body(image.body(), Precision::single_);
    const Boundary surface(body.model(), 0.02);
    EXPECT_EQ(flipped(surface, body.model()), 0);
    FacePress press(surface, body.model(), RigidShape::sphere(0.010));
    const ShapePose pose = pose_along(1e-3 * at, out);
    std::vector<std::uint32_t> near;
    for (std::uint32_t f = 0; f < surface.surface().facets.size(); ++f)
      if ((surface.settled_centroid(f) - pose.tip).norm() < 0.03) near.push_back(f);
    double force = 0;
    body.after_step = [&](double dt) {
      if (press.depth() < 0.008) force += 10 * dt;  // [N/s]
      press.list(pose, near);
      press.press(pose, force, dt);
      body.model().kick(press.forces(), dt);
    };
    body.run(0.6, [](const Vec3&, double) { return Vec3(Vec3::Zero()); });
    std::printf("leans by %4.1f degrees: %.2f N, %.2f mm deep, %d triangles folded, least J %.2f\n", degrees,
                force, 1e3 * press.depth(), flipped(surface, body.model()), body.least_corner_J());
    EXPECT_GT(press.depth(), 0.0075);
    EXPECT_EQ(flipped(surface, body.model()), 0) << degrees;
  }
}

TEST(Touch, SlidesOverFacesWithoutAHop) {
  World world(scene_of(block(5)));
  Hand hand;
  for (int n = 0; n < 1000; ++n) hand.frame(world, 0.15);
  double least = 1e9, most = 0, hop = 0, before = depth_of(world);
  for (int n = 0; n < 1500; ++n) {
    hand.frame(world, 0.15, {5e-6 * n, 1.3e-6 * n, 0});
    const double depth = depth_of(world);
    least = std::min(least, depth), most = std::max(most, depth);
    hop = std::max(hop, std::abs(depth - before));
    before = depth;
  }
  std::printf("depth %.4f to %.4f mm, %.2f um in a frame at the most\n", 1e3 * least, 1e3 * most, 1e6 * hop);
  EXPECT_LT(most / least, 1.06);
  EXPECT_LT(hop, 5e-6);  // as the sphere goes on by 5 um a frame
}

/// Undamped, pressed and let go within a second: what the hand gave comes back.
TEST(Touch, GivesBackWhatItTook) {
  struct Case {
    const char* name;
    Recipe recipe;
    const char* integrator;
    double force;  // [N]; springs under more are crushed, and swing for ever
  };
  for (const Case& c : {Case{"elements", block(5, ""), "symplectic_euler", 0.2},
                        Case{"springs", springs(5, ""), "symplectic_euler", 0.02},
                        Case{"springs", springs(5, ""), "velocity_verlet", 0.02}}) {
    Recipe recipe = c.recipe;
    recipe.precision = "double";
    recipe.physics = std::string("integrator = \"") + c.integrator + "\"";
    World world(scene_of(recipe));
    Hand hand;
    double most = 0, error = 0;
    for (int n = 0; n < 2000; ++n) {
      const double t = 1e-3 * n;
      hand.frame(world, t < 1 ? 0.5 * c.force * (1 - std::cos(2 * std::numbers::pi * t)) : 0);
      most = std::max(most, world.report().tool_work);
      if (n % 20 == 0) error = std::max(error, std::abs(world.ledger().missing()));
    }
    const EnergyLedger ledger = world.ledger();
    std::printf("%s, %s: %.4g J given, %.4g J kept, books within %.2g\n", c.name, c.integrator, most,
                ledger.kinetic + ledger.elastic, error / most);
    EXPECT_GT(most, 1e-6);
    EXPECT_LT(ledger.kinetic + ledger.elastic, 0.02 * most);
    EXPECT_NEAR(world.report().tool_work, 0, 0.02 * most);
    EXPECT_LT(error, 0.01 * most);
  }
}

TEST(Touch, HasTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = block(5);
    recipe.physics = "threads = " + std::to_string(threads);
    World world(scene_of(recipe));
    Hand hand;
    for (int n = 0; n < 150; ++n) hand.frame(world, 0.2, {1e-5 * n, 0, 0});
    EXPECT_GT(depth_of(world), 0.0001);
    if (first == 0) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads;
  }
}

/// A body that flies: what the sphere gives is what it gets.
TEST(Touch, GivesABodyItsMomentum) {
  Recipe recipe = block(5);
  recipe.body = "model = \"fem\"";
  recipe.precision = "double";
  World world(scene_of(recipe));
  Hand hand;
  Vec3 given = Vec3::Zero();
  for (int n = 0; n < 60; ++n) {
    hand.frame(world, 0.05, {0.004, -0.002, 0});
    given -= world.frame_seconds() * world.tool(0).force();
  }
  const Momenta now = world.body(0).momenta();
  EXPECT_GT(given.norm(), 1e-4);
  EXPECT_LT((now.linear - given).norm(), 1e-9 * given.norm());
  const MomentumBalance balance = world.body(0).momentum_balance();
  EXPECT_LT(balance.missing.linear.norm(), 1e-9 * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), 1e-9 * balance.angular);
}

}  // namespace
}  // namespace palpate::physics::test
