#include "physics_node/contact/press_by.h"

#include <gtest/gtest.h>

#include "haptic_node/tissue/contact_spring.h"

namespace palpate::physics {
namespace {

/// The two sides of the wire have one law.
TEST(PressBy, IsTheSpringThatTheHandFeels) {
  const haptic::ContactSpring hand{500, 1};
  for (const double p : {-1e-3, 0.0, 1e-5, 1e-3, 4e-3})
    for (const double rate : {-2.0, -0.05, 0.0, 0.05, 2.0}) {
      const PressBy by{.stiffness = 500, .damping = 1, .lead = rate - p / 1e-4, .dt = 1e-4, .most = 1e9};
      EXPECT_NEAR(by.at(-p), hand.force(0, 1e-3, p, rate, 0), 1e-12) << p << " " << rate;
    }
}

TEST(PressBy, GivesNoMoreThanTheHandFeels) {
  const PressBy by{.stiffness = 500, .damping = 1, .lead = 0, .dt = 1e-4, .most = 0.25};
  EXPECT_EQ(by.at(-0.1), 0.25);
  EXPECT_FALSE((PressBy{.stiffness = 500, .most = 0}.presses()));
  EXPECT_EQ((PressBy{.force = 2}.at(-1)), 2) << "a given force is what it is";
}

}  // namespace
}  // namespace palpate::physics
