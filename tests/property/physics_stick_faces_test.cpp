// A stick far thinner than the cells meets the faces between masses: from wherever it comes, it does not pass.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/message/vec3.h"
#include "physics_node/collision/point_triangle.h"
#include "physics_node/contact/stick_faces.h"
#include "physics_node/contact/stick_tool.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double r = 0.001;

TEST(StickFace, GivesWayToTheRadius) {
  const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0)};  // faces up
  const auto along_x = [](double z) { return Stick{Vec3(-0.02, 0.003, z), Vec3(0.06, 0, 0), r}; };
  EXPECT_FALSE(meet(along_x(1.01 * r), x).hit);
  for (const double z : {0.9 * r, 0.1 * r, 0.0}) {
    const FaceHit above = meet(along_x(z), x);
    ASSERT_TRUE(above.hit) << z;
    EXPECT_NEAR(above.depth, r - z, 1e-12);
    EXPECT_LT((above.push + Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_NEAR(above.weight.sum(), 1, 1e-12);
  }
  // A tip that has come through by less than the radius goes back by the way it came.
  const FaceHit through = meet({Vec3(0.002, 0.002, -0.0004), Vec3(0, 0, 0.05), r}, x);
  ASSERT_TRUE(through.hit);
  EXPECT_NEAR(through.depth, r + 0.0004, 1e-12);
  EXPECT_LT((through.push + Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_FALSE(meet({Vec3(0.002, 0.002, -0.0012), Vec3(0, 0, 0.05), r}, x).hit)
      << "it belongs to the other side";
  // Beside an edge, from outside: away from the edge.
  const FaceHit edge = meet({Vec3(-0.02, -0.0005, 0.0005), Vec3(0.06, 0, 0), r}, x);
  ASSERT_TRUE(edge.hit);
  EXPECT_NEAR(edge.depth, r - 0.0005 * std::numbers::sqrt2, 1e-12);
  EXPECT_LT((edge.push - Vec3(0, 1, -1).normalized()).norm(), 1e-9);
}

Scene block(const std::string& lattice, double radius, const std::string& held = "\"-z\"") {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = Recipe::box(40, 40, 20);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\nviscosity_Pa_s = 5";
  recipe.body = "fixed = [" + held + "]";
  recipe.world = fmt::format(
                     "[[tool]]\nname = \"stick\"\nshape = \"stick\"\nlength_mm = 60\nradius_mm = {}\ndevice "
                     "= \"hand\"\nlow_pass_Hz = 40\n",
                     1e3 * radius) +
                 "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  return scene_of(recipe);
}

/// How many times a ray up from p crosses the surface is odd inside.
bool is_inside(const Vec3& p, const Surface& surface, const NodeMotion& moving) {
  bool inside = false;
  for (const auto& facet : surface.facets)
    for (std::size_t half = 0; half < 2; ++half) {
      const Vec3 a = surface.position(facet[0], moving), b = surface.position(facet[1 + half], moving),
                 c = surface.position(facet[2 + half], moving);
      const auto cross = [](const Vec3& u, const Vec3& v) { return u.x() * v.y() - u.y() * v.x(); };
      const double whole = cross(b - a, c - a);
      if (whole == 0) continue;
      const double wb = cross(p - a, c - a) / whole, wc = cross(b - a, p - a) / whole;
      if (wb < 0 || wc < 0 || wb + wc > 1) continue;
      if (a.z() + wb * (b - a).z() + wc * (c - a).z() > p.z()) inside = !inside;
    }
  return inside;
}

double distance(const Vec3& p, const Surface& surface, const NodeMotion& moving) {
  double least = 1;
  for (const auto& facet : surface.facets)
    for (std::size_t half = 0; half < 2; ++half)
      least = std::min(least, closest_point(p, {surface.position(facet[0], moving),
                                                surface.position(facet[1 + half], moving),
                                                surface.position(facet[2 + half], moving)})
                                  .distance);
  return least;
}

struct Press {
  std::string lattice;
  Vec3 axis, from, way;
  double speed = 0, radius = r;
};

/// @return how deep a point of the axis ever was inside the tissue [m]
double deepest(const Press& press) {
  World world(block(press.lattice, press.radius));
  const Boundary surface(world.body(0), 0.02);
  const auto& tool = dynamic_cast<const StickTool&>(world.tool(0));
  ToolState state;
  state.engaged = 1;
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3(-press.axis));
  state.q_WT = {q.w(), q.x(), q.y(), q.z()};
  const int frames = static_cast<int>(std::ceil(press.way.norm() / press.speed / world.frame_seconds()));
  double deepest = 0;
  for (int n = -1; n < frames + 20; ++n) {
    const double done = std::clamp(static_cast<double>(n) / frames, 0.0, 1.0);
    state.p_WT = state.proxy = array(press.from + done * press.way);
    ++state.tick;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
    if (n < 0) continue;
    const Stick stick = tool.stick_at({tool.tip(), q});
    for (int k = 0; k <= 60; ++k)
      if (const Vec3 p = stick.axis_point(k / 60.0); is_inside(p, surface.surface(), world.body(0)))
        deepest = std::max(deepest, distance(p, surface.surface(), world.body(0)));
  }
  return deepest;
}

/// The middle of the stick comes down on a point of the block's upper side, the stick tilted by up to 60 degrees, by 3 to 6 mm below it.
Press draw(Dice& dice, double radius, double deepest) {
  Press press;
  press.radius = radius;
  press.lattice = dice.between(0, 1) < 0.5 ? "fcc" : "voxel";
  const double turn = dice.between(0, 2 * std::numbers::pi), tilt = dice.between(0, std::numbers::pi / 3);
  press.axis = Vec3(std::cos(turn) * std::cos(tilt), std::sin(turn) * std::cos(tilt), std::sin(tilt));
  const double top = 0.010, depth = dice.between(0.5 * deepest, deepest);
  // The lowest point of the stick, its tip, or all of it where it lies flat, begins 3 mm above the block.
  press.from = Vec3(dice.between(-0.02, 0.005), dice.between(-0.02, 0.005), top + radius + 0.003);
  press.way = Vec3(dice.between(-0.002, 0.002), dice.between(-0.002, 0.002), -(0.003 + radius + depth));
  press.speed = std::exp(dice.between(std::log(0.05), std::log(1.0)));
  return press;
}

/// The axis stays outside, or is in by less than half the radius for a frame; by less than the radius where a tip presses within two
/// radii of the rim, whose faces fold over.
struct Case {
  double radius, deepest;
};
class StickFaces : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Radii, StickFaces,
                         testing::Values(Case{0.001, 0.006}, Case{0.002, 0.008}, Case{0.003, 0.010},
                                         Case{0.005, 0.012}));

TEST_P(StickFaces, LetNothingThrough) {
  const char* wanted = std::getenv("PALPATE_STICKS");
  const int n_poses = wanted != nullptr ? std::atoi(wanted) : 100;
  const auto [radius, deep] = GetParam();
  Dice dice(20);
  int inside = 0;
  double worst = 0;
  for (int n = 0; n < n_poses; ++n) {
    const Press press = draw(dice, radius, deep);
    const double depth = deepest(press);
    inside += depth > 0 ? 1 : 0;
    worst = std::max(worst, depth);
    const double to_rim = 0.020 + std::min(press.from.x(), press.from.y());
    EXPECT_LT(depth, (to_rim < 2 * radius ? 1.0 : 0.5) * radius)
        << fmt::format("pose {}: {}, axis {:.3f} {:.3f} {:.3f}, from {:.4f} {:.4f} {:.4f}, {:.2f} m/s", n,
                       press.lattice, press.axis.x(), press.axis.y(), press.axis.z(), press.from.x(),
                       press.from.y(), press.from.z(), press.speed);
  }
  fmt::print("{:.0f} mm: in {} of {} poses the axis was inside, at most {:.2g} mm\n", 1e3 * radius, inside,
             n_poses, 1e3 * worst);
}

/// A stick that lies across held rims cannot come out there, whoever leads it. Its neighbours must not pay for that: what has a
/// small share in a face of held corners is not thrown off by the whole of its depth.
TEST(HeldRim, ThrowsNothingOff) {
  for (const char* lattice : {"fcc", "voxel"})
    for (const double speed : {0.05, 1.0}) {
      World world(block(lattice, 0.001, "\"-x\", \"+x\""));
      ToolState state;
      state.engaged = 1;
      const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3(-Vec3::UnitX()));
      state.q_WT = {q.w(), q.x(), q.y(), q.z()};
      const Vec3 from(-0.030, 0.001, 0.014);
      constexpr double down = 0.008;
      double fastest = 0;
      const int frames = static_cast<int>(std::ceil(down / speed / world.frame_seconds()));
      for (int n = 0; n < frames + 50; ++n) {
        state.p_WT = state.proxy =
            array(from - down * std::min(1.0, static_cast<double>(n) / frames) * Vec3::UnitZ());
        ++state.tick;
        const std::optional<ToolState> hand = state;
        world.frame(std::span(&hand, 1));
        for (const Index node : world.body(0).body().nodes())
          fastest = std::max(fastest, world.body(0).velocity(node).norm());
      }
      SCOPED_TRACE(fmt::format("{}, {} m/s", lattice, speed));
      EXPECT_GT(fastest, 0.1 * speed) << "it was pressed";
      EXPECT_LT(
          fastest,
          4 * (speed + 0.25));  // its own speed and that at which faces come out again, by unequal corners
      EXPECT_LT(world.ledger().balance_error(), 0.02);
      EXPECT_LT(world.ledger().exchanged, 0.02);  // [J]; a few newtons over 4 mm
    }
}

}  // namespace
}  // namespace palpate::physics::test
