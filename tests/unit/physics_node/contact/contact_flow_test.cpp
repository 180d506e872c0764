#include "physics_node/contact/contact_flow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::physics {
namespace {

Body elements(double beta, std::vector<Relaxation> relaxation) {
  Body body;
  body.solid.emplace();
  body.solid->beta = beta;
  body.solid->relaxation = std::move(relaxation);
  return body;
}

TEST(ContactFlow, CostsNothingOfWhatDoesNotFlow) {
  ContactFlow flow;
  flow.begin(elements(0.05e-3, {}));
  EXPECT_TRUE(flow.branches().empty());
  flow.pass(2, 1e-3);
  EXPECT_EQ(flow.staying(), 2);
  EXPECT_EQ(flow.lasting(), 1);
}

/// F at once and held: F_e = F (1 - e^(-t / beta)), by small steps and by long ones.
TEST(ContactFlow, CreepsByItsViscosity) {
  ContactFlow flow;
  flow.begin(elements(5e-3, {}));
  ASSERT_EQ(flow.branches().size(), 1u);
  for (const double dt : {0.1e-3, 1e-3}) {
    flow.rest();
    flow.pass(1, 1e-9);
    for (double t = dt; t < 20e-3; t += dt) {
      flow.pass(1, dt);
      // The short branch bears at once what a dashpot does not let go.
      EXPECT_NEAR(flow.staying(), -std::expm1(-t / 5e-3), 0.06) << dt << " at " << t;
    }
    flow.pass(1, 0.1);
    flow.pass(1, 0.1);
    EXPECT_NEAR(flow.staying(), 1, 1e-4);
  }
}

/// What stays of a sudden force is E_inf / E of what stays of it for ever, and comes there with tau E / E_inf.
TEST(ContactFlow, CreepsAsAStandardLinearSolid) {
  ContactFlow flow;
  flow.begin(elements(0, {{0.4, 0.1}}));
  EXPECT_NEAR(flow.lasting(), 0.6, 1e-15);
  flow.pass(3, 1e-9);
  EXPECT_NEAR(flow.staying(), 3 * 0.6, 1e-6);
  for (double t = 1e-3; t < 1; t += 1e-3) {
    flow.pass(3, 1e-3);
    EXPECT_NEAR(flow.staying(), 3 * (1 - 0.4 * std::exp(-0.6 * t / 0.1)), 1e-4);
  }
  flow.pass(0, 1e-9);  // gone: it has not forgotten
  EXPECT_GT(flow.staying(), 1);
  flow.rest();
  EXPECT_EQ(flow.staying(), 0);
}

/// Springs by c / k; dampers of all relative motion take 2.4 times as much, drag is none of the tissue's own.
TEST(ContactFlow, IsOfTheDampersOfSprings) {
  Body body;
  body.law.k1.fill(100);
  body.law.c.fill(0.5);
  ContactFlow flow;
  for (const auto& [damper, times] : {std::pair{Damper::axial, 1.0}, std::pair{Damper::relative, 2.4}}) {
    body.law.damper = damper;
    flow.begin(body);
    ASSERT_EQ(flow.branches().size(), 1u);
    EXPECT_NEAR(flow.branches()[0].share * flow.branches()[0].time, times * 5e-3, 1e-12);
  }
  body.law.damper = Damper::drag;
  flow.begin(body);
  EXPECT_TRUE(flow.branches().empty());
}

TEST(ContactFlow, HasRoomForAllThatAMaterialMayBe) {
  ContactFlow flow;
  flow.begin(elements(1e-3, {{0.2, 0.01}, {0.2, 0.1}, {0.2, 1}, {0.2, 10}}));
  ASSERT_EQ(flow.branches().size(), 5u);
  EXPECT_TRUE(flow.branches()[0].viscous);
  double all = 1;
  for (const auto& branch : flow.branches())
    if (!branch.viscous) all += branch.share;
  EXPECT_NEAR(all * flow.lasting(), 1, 1e-12);
}

}  // namespace
}  // namespace palpate::physics
