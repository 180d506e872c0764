// A tool that spans two bodies: they bear it together, and neither is gone through.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/physics/palpation.h"

namespace palpate::physics::test {
namespace {

const Vec3 plate_m(24e-3, 12e-3, 5e-3);
constexpr const char* plate = "shape = \"box\"\nsize_mm = [24, 12, 5]";

/// Two slabs on a table beside each other, 1 mm apart at x = 0.
struct Pair {
  double other_kPa = 20;  // modulus of the one at x > 0
  double other_z = 0;     // by how much its top is higher [mm]
  std::string tool = "radius_mm = 4";
  std::string other_model = "fem";
  Scene scene() const {
    Recipe recipe = palpated_by(tool);
    recipe.body += "\nat_mm = [-24.5, 0, 0]";
    recipe.world = fmt::format(
                       "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"{}\"\nspacing_mm = "
                       "4\nshape = \"box\"\n"
                       "size_mm = [48, 48, 20]\nat_mm = [24.5, 0, {}]\nfixed = [\"-z\"]\nmaterial = \"n\"\n"
                       "[material.n]\ndensity_kg_per_m3 = 1000\nviscosity_Pa_s = 10\nmodulus_kPa = {}\n",
                       other_model, other_z, other_kPa) +
                   recipe.world;
    return scene_of(recipe);
  }
};

struct Hand {
  explicit Hand(const Pair& pair) : world(pair.scene()) {}
  /// Leads the tip along a path until `seconds` have gone since it began.
  void lead(const std::function<Vec3(double)>& path, double seconds) {
    for (; n <= static_cast<std::uint64_t>(1e3 * seconds); ++n) {
      const std::optional<ToolState> hand = recorded_hand(path, n);
      world.frame(std::span(&hand, 1));
      world.tool(0).write_patch(patch, 1, 0);
    }
  }
  Vec3 on(std::size_t body) const {
    return total(dynamic_cast<const PressingTool&>(world.tool(0)).forces_on(body));
  }
  Vec3 all() const { return on(0) + on(1); }
  /// How far a node of a body is inside the plate, whose middle the hand leads to `led` [m].
  double inside(std::size_t body, const Vec3& led) const {
    const Vec3 lies = led + world.tool(0).borne() / 500;
    const BodyModel& moving = world.body(body);
    double most = 0;
    for (Index node = 0; node < static_cast<Index>(moving.body().inverse_mass.size()); ++node) {
      if (!(moving.body().inverse_mass[static_cast<std::size_t>(node)] > 0)) continue;
      const Vec3 to_side =
          0.5 * plate_m - (moving.position(node) - lies - 0.5 * plate_m.z() * Vec3::UnitZ()).cwiseAbs();
      most = std::max(most, to_side.minCoeff());
    }
    return most;
  }
  World world;
  ContactPatch patch;
  std::uint64_t n = 1;
};

/// Down over 0.1 s to `deep` below the slab's top at (x, 0.5 mm), and there.
std::function<Vec3(double)> down(double x, double deep) {
  return [=](double t) {
    const double in = -1e-3 + (deep + 1e-3) * std::clamp((t - 0.05) / 0.1, 0.0, 1.0);
    return Vec3(x, 0.0005, slab_top - in);
  };
}

TEST(TissueBodies, BearTheirHalvesOfABallOverTheSeam) {
  Hand seam(Pair{}), within(Pair{});
  seam.lead(down(0, 4e-3), 0.4);
  within.lead(down(-24.5e-3, 4e-3), 0.4);
  const double force = seam.world.tool(0).borne().z();
  EXPECT_GT(force, 0.2);
  EXPECT_NEAR((seam.all() + seam.world.tool(0).borne()).norm(), 0, 1e-3 * force);
  EXPECT_NEAR(seam.on(0).z(), seam.on(1).z(), 0.02 * force);
  EXPECT_NEAR(seam.on(0).x(), -seam.on(1).x(), 0.02 * force);
  EXPECT_LT(seam.on(0).x(), -0.05 * force) << "it pushes them apart";
  EXPECT_GT(force, 0.5 * within.world.tool(0).borne().z()) << "beside a gap tissue is softer";
  EXPECT_LT(force, within.world.tool(0).borne().z());
  EXPECT_NEAR(vec(seam.patch.tissues[0].force).z(), -force, 1e-3 * force) << "and the hand feels both";
}

/// Whichever body it has come to first, it stays out of the other.
TEST(TissueBodies, AreBothKeptOutOfAPlate) {
  for (const double other_z : {-1.0, 1.0}) {
    Hand hand(Pair{.other_kPa = 60, .other_z = other_z, .tool = plate});
    const auto path = down(1e-3, 4e-3);
    hand.lead(path, 0.4);
    EXPECT_LT(hand.on(0).z(), -0.05);
    EXPECT_LT(hand.on(1).z(), -0.05);
    for (const std::size_t body : {0u, 1u})
      EXPECT_LT(hand.inside(body, path(1)), 0.1e-3) << body << ' ' << other_z;
  }
}

/// A ball between a floor and a wall of another body.
TEST(TissueBodies, PressABallFromTwoSides) {
  Hand hand(Pair{.other_z = 12});
  const auto path = [](double t) {
    const double s = std::clamp((t - 0.05) / 0.3, 0.0, 1.0);
    return Vec3(-6e-3 + 4.5e-3 * s, 0.0005, slab_top + 2e-3 - 4.5e-3 * s);
  };
  hand.lead(path, 0.8);
  const Vec3 force = hand.world.tool(0).borne();
  EXPECT_LT(hand.on(0).z(), -0.1) << "the floor";
  EXPECT_GT(hand.on(1).x(), 0.1) << "the wall";
  EXPECT_NEAR(hand.on(1).z() / hand.on(1).x(), 0, 0.3);
  EXPECT_NEAR((hand.all() + force).norm(), 0, 1e-3 * force.norm());
}

/// Under a plate wider than the gap the moment of both is that of the arm that the hand is told.
TEST(TissueBodies, BearAPlateWithItsMoment) {
  Hand hand(Pair{.other_kPa = 60, .tool = plate});
  const auto path = down(0, 2e-3);
  hand.lead(path, 0.4);
  const TouchedTissue& told = hand.patch.tissues[0];
  const double force = hand.world.tool(0).borne().z();
  EXPECT_GT(-hand.on(1).z(), 1.8 * -hand.on(0).z());
  EXPECT_LT(-hand.on(1).z(), 3.2 * -hand.on(0).z())
      << "three times as stiff, less what the hand's spring takes";
  Vec3 moment = Vec3::Zero();
  const Vec3 lies = path(1) + force / 500 * Vec3::UnitZ();
  for (const std::size_t body : {0u, 1u})
    for (const NodalForce& f : dynamic_cast<const PressingTool&>(hand.world.tool(0)).forces_on(body))
      moment += (hand.world.body(body).position(f.cell) - lies).cross(f.force);
  EXPECT_GT(told.arm[0], 3e-3);
  EXPECT_NEAR((moment - vec(told.arm).cross(vec(told.force))).norm(), 0, 1e-3 * force);
}

/// A hand that touches takes no other number of modes: springs have none of their own.
TEST(TissueBodies, AreToldWithAsManyModesWhicheverBears) {
  Hand hand(Pair{.other_model = "springs"});
  const auto path = [](double t) {
    const double in = 3e-3 * std::min(1.0, t / 0.1) - 1e-3;
    return Vec3(-10e-3 + 20e-3 * std::clamp((t - 0.15) / 0.3, 0.0, 1.0), 0.0005, slab_top - in);
  };
  double before = 0;
  for (int n = 1; n <= 600; ++n) {
    hand.lead(path, 1e-3 * n);
    const TouchedTissue& told = hand.patch.tissues[0];
    if (n < 100) continue;
    ASSERT_EQ(told.n_modes, 9u) << n;
    const double force = vec(told.force).norm();
    EXPECT_NEAR(force, hand.world.tool(0).borne().norm(), 1e-9 + 1e-3 * force) << n;
    EXPECT_LT(std::abs(force - before), n > 100 ? 0.03 : 1) << n;
    before = force;
  }
  EXPECT_LT(hand.on(1).z(), -0.05);
  for (const ModeOfTissue& mode : hand.patch.tissues[0].modes) EXPECT_EQ(vec(mode.psi).norm(), 0);
}

/// From one to the other and back, as often as the hand likes: no blow, and no energy out of it.
TEST(TissueBodies, GiveNoEnergyOnTheWayFromOneToTheOther) {
  Hand hand(Pair{});
  const auto path = [](double t) {
    const double in = 3e-3 * std::min(1.0, t / 0.2) - 1e-3;
    return Vec3(-7e-3 * std::cos(2 * M_PI * 1.25 * std::max(0.0, t - 0.2)), 0.0005, slab_top - in);
  };
  Vec3 before_x = path(0), before = Vec3::Zero();
  double most_step = 0, given = 0, back = 0;
  for (int n = 1; n <= 2200; ++n) {
    hand.lead(path, 1e-3 * n);
    const Vec3 x = path(1e-3 * n), force = hand.world.tool(0).borne();
    const double work = -0.5 * (force + before).dot(x - before_x);
    (n <= 600 ? given : back) += work;
    if (n > 200) most_step = std::max(most_step, (force - before).norm());
    before_x = x, before = force;
  }
  EXPECT_LT(most_step, 0.03);
  EXPECT_GT(back, -0.01 * given) << "in four ways over it";
  EXPECT_GT(before.z(), 0.1);
  EXPECT_LT(hand.world.ledger().balance_error(), 1e-3);
}

}  // namespace
}  // namespace palpate::physics::test
