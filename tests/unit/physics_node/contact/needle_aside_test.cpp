// A rigid needle across its axis: how tissue holds it, and what it cuts where it is led aside.

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "physics_node/contact/near_needle.h"
#include "tests/unit/physics_node/contact/led_needle.h"

namespace palpate::physics::test {
namespace {

/// Led aside in tissue, it takes that along: the hand is held across, on every side alike, and less where tissue is
/// softer.
TEST(Needle, IsHeldAcross) {
  const auto held = [](int modulus_kPa, const Vec3& way) {
    Needle needle(block({.modulus_kPa = modulus_kPa}));
    const Vec3 deep = at_depth(0.020);
    needle.along(deep, 0.05);
    needle.along(deep + way, 0.02);
    const std::vector<Vec3> rest(needle.path.end() - 1, needle.path.end());
    Vec3 force;
    for (int n = 0; n < 100; ++n) force = needle.to(rest.front());
    EXPECT_EQ(needle.world.report().restored, 0);
    EXPECT_GT(needle.world.report().least_corner_J, 0.2);
    return Vec3(-force);
  };
  const Vec3 stiff = held(60, Vec3(0, 0.002, 0)), soft = held(15, Vec3(0, 0.002, 0)),
             other = held(60, Vec3(0, -0.002, 0));
  EXPECT_GT(stiff.y(), 0.2);
  EXPECT_NEAR(other.y(), -stiff.y(), 0.1 * stiff.y());
  EXPECT_LT(soft.y(), 0.6 * stiff.y());
  EXPECT_LT(std::abs(stiff.x()), 0.05 * stiff.y());
}

/// How it dents tissue before it enters, and how that holds it across, is of the tissue and not of its cells.
TEST(Needle, DentsAndIsHeldAlikeOnAnyCells) {
  for (const double modulus : {20e3, 60e3}) {
    std::vector<double> dents, across;
    for (const double cell : {1.5, 2.0, 3.0}) {
      Needle needle(block({.cell_mm = cell, .modulus_kPa = static_cast<int>(1e-3 * modulus)}));
      double dent = 0, force = 0;
      while (needle.book().punctures() == 0 && dent < 0.02) {
        force = needle.to(needle.path.back() - Vec3(0, 0, 2e-5)).z();
        dent = top - needle.path.back().z() - force / 1000;
      }
      dents.push_back(dent);
      needle.along(at_depth(0.020), 0.05);
      needle.along(at_depth(0.020) + Vec3(0, 0.001, 0), 0.02);
      Vec3 held;
      for (int n = 0; n < 100; ++n) held = needle.to(needle.path.back());
      across.push_back(-held.y());
    }
    const NearNeedle thick{
        .modulus = modulus, .poisson_ratio = 0.45, .radius = 0.5 * diameter, .reach = 0.004};
    for (std::size_t n = 0; n < dents.size(); ++n) {
      EXPECT_NEAR(dents[n], thick.dent(ratio * goes_on), 0.12 * dents[n]) << n << " " << modulus;
      EXPECT_NEAR(across[n], across[0], 0.12 * across[0]) << n << " " << modulus;
    }
  }
}

/// In, drawn back, aside, in again and back aside: no spring is stretched that the hand has not stretched.
TEST(Needle, GivesTheHandNothingRoundALoop) {
  for (const double wide : {0.0005, 0.002}) {
    Recipe recipe = block({.modulus_kPa = 20});
    recipe.world = tool(0);
    Needle needle(recipe);
    const Vec3 beside(wide, 0, 0);
    needle.work_to(at_depth(0.019), 0.05);
    for (int n = 0; n < 4; ++n) {
      double work = needle.work_to(at_depth(0.002), 0.1);
      work += needle.work_to(at_depth(0.002) + beside, 0.03);
      work += needle.work_to(at_depth(0.018) + beside, 0.1);
      work += needle.work_to(at_depth(0.018), 0.03);
      if (n == 0) continue;  // it begins with the tip pressed on, and ends without
      EXPECT_GT(work, 0) << wide << " " << n;
    }
    EXPECT_EQ(needle.world.report().restored, 0);
  }
}

/// Drawn back and led aside by more than it is wide, it finds no channel before it.
TEST(Needle, CutsAnewBesideItsChannel) {
  Needle needle(block());
  needle.along(at_depth(0.018), 0.05);
  needle.along(at_depth(0.004), 0.05);
  const Vec3 beside(0, 0.008, 0);
  needle.along(at_depth(0.004) + beside, 0.05);
  needle.along(at_depth(0.008) + beside, 0.05);
  const double opened = needle.book().cut_area();
  needle.along(at_depth(0.016) + beside, 0.05);
  EXPECT_NEAR(needle.book().cut_area() - opened, diameter * 0.008, 0.1 * diameter * 0.008);
}

/// Its path inclined to its axis: it cuts with its tip and with its side, by no more than tissue bears.
TEST(Needle, GoesObliquely) {
  for (const int modulus : {15, 60})
    for (const double degrees : {10.0, 30.0, 50.0}) {
      Needle needle(block({.modulus_kPa = modulus}));
      const double depth = 0.014, aside = std::tan(degrees * std::numbers::pi / 180) * depth;
      const Vec3 away(0, std::min(aside, 0.012), 0);
      needle.path.assign(2, at_depth(-0.001) - 0.5 * away);
      double most = 0;
      for (const Vec3& f : needle.along(at_depth(depth) + 0.5 * away, 0.05)) most = std::max(most, f.norm());
      const double bears = ratio * toughness * (depth + diameter) + friction * depth;
      EXPECT_LT(most, 1.1 * bears) << modulus << " " << degrees;
      EXPECT_LT(needle.world.tool(0).contacts(), 20U);
      EXPECT_LT(needle.world.ledger().balance_error(), 0.01);
      EXPECT_EQ(needle.world.report().restored, 0);
      EXPECT_EQ(needle.book().punctures(), 1);
    }
}

/// It dents tissue, slides off an edge of it, and is free.
TEST(Needle, SlidesOffAnEdge) {
  Needle needle(block());
  const Vec3 up(0.0003, 0.0135, top + 0.003);
  needle.path.assign(2, up);
  const Vec3 pressed = needle.along(up - Vec3(0, 0, 0.0045), 0.02).back();
  EXPECT_GT(pressed.z(), 0.03);
  needle.along(up + Vec3(0, 0.012, -0.0045), 0.05);
  EXPECT_LT(needle.to(needle.path.back()).norm(), 1e-12);
  EXPECT_EQ(needle.book().punctures(), 0);
}

/// Barely in, and led aside: it ploughs on at what tissue bears, and the hand pays for it.
TEST(Needle, PloughsWhereItIsShallow) {
  Needle needle(block());
  needle.along(at_depth(0.006), 0.05);
  needle.along(at_depth(0.003), 0.05);
  const double opened = needle.book().cut_area();
  needle.along(at_depth(0.003) + Vec3(0, 0.010, 0), 0.05);
  EXPECT_GT(needle.book().cut_area(), opened + 3e-6);
  EXPECT_LT(needle.world.tool(0).borne().norm(), ratio * toughness * (0.003 + diameter) * 1.2);
  EXPECT_EQ(needle.world.report().restored, 0);
}

/// A handle that whirls round in tissue tears it open rather than turning it inside out.
TEST(Needle, SurvivesAHandleThatWhirls) {
  Needle needle(block({.modulus_kPa = 15}));
  needle.along(at_depth(0.020), 0.05);
  for (int n = 0; n < 200; ++n) {
    needle.path.push_back(at_depth(0.020));
    std::optional<ToolState> hand =
        recorded_hand([&](double) { return at_depth(0.020); }, needle.path.size() - 1);
    const double half = 0.5 * 0.02 * n;
    hand->q_WT = {std::cos(half), std::sin(half), 0, 0};
    needle.world.frame(std::span(&hand, 1));
  }
  EXPECT_TRUE(needle.world.body(0).is_finite());
  EXPECT_EQ(needle.world.report().restored, 0);
  EXPECT_LT(needle.world.tool(0).borne().norm(), 20);
}

}  // namespace
}  // namespace palpate::physics::test
