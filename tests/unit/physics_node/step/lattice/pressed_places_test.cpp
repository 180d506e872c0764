#include "physics_node/step/lattice/pressed_places.h"

#include <gtest/gtest.h>

namespace palpate::physics {
namespace {

TEST(PressedPlaces, AreTheMiddlesOfForcesThatLieTogether) {
  PressedPlaces places(0.01);
  EXPECT_TRUE(places.note(Vec3(0, 0, 0), Vec3(0, 0, -1)));
  EXPECT_FALSE(places.note(Vec3(0.004, 0, 0), Vec3(0, 0, -3)));
  EXPECT_TRUE(places.note(Vec3(0.05, 0, 0), Vec3(0, 0, -2)));
  places.look(0.01);
  ASSERT_EQ(places.now().size(), 2U);
  EXPECT_NEAR(places.now()[0].at.x(), 0.003, 1e-12);
  EXPECT_EQ(places.now()[0].weight, 4);
  EXPECT_EQ(places.now()[0].push, Vec3(0, 0, -4));
  EXPECT_NEAR(places.now()[1].at.x(), 0.05, 1e-12);
  EXPECT_EQ(places.now()[1].weight, 2);
}

TEST(PressedPlaces, FollowAFinger) {
  PressedPlaces places(0.01);
  for (int n = 0; n < 100; ++n) {
    EXPECT_EQ(places.note(Vec3(0.001 * n, 0, 0), Vec3(0, 0, -1)), n == 0);
    places.look(0.01);
    ASSERT_EQ(places.now().size(), 1U);
    EXPECT_NEAR(places.now()[0].at.x(), 0.001 * n, 1e-12);
  }
}

TEST(PressedPlaces, AreForgottenAfterHalfASecond) {
  PressedPlaces places(0.01);
  places.note(Vec3::Zero(), Vec3(0, 0, -1));
  places.look(0.01);
  for (int n = 0; n < 49; ++n) places.look(0.01);
  ASSERT_EQ(places.now().size(), 1U);
  EXPECT_EQ(places.now()[0].weight, 0);
  places.note(Vec3::Zero(), Vec3(0, 0, -1));
  for (int n = 0; n < 50; ++n) places.look(0.01);
  EXPECT_EQ(places.now().size(), 1U);  // pressed in the first of them
  for (int n = 0; n < 2; ++n) places.look(0.01);
  EXPECT_TRUE(places.now().empty());
}

TEST(PressedPlaces, OfTwoThatMeetTheHarderPressedStays) {
  PressedPlaces places(0.01);
  places.note(Vec3(0, 0, 0), Vec3(0, 0, -1));
  places.note(Vec3(0.02, 0, 0), Vec3(0, 0, -2));
  places.look(0.01);
  for (int n = 1; n <= 8; ++n) {
    places.note(Vec3(0.002 * n, 0, 0), Vec3(0, 0, -1));
    places.note(Vec3(0.02, 0, 0), Vec3(0, 0, -2));
    places.look(0.01);
  }
  ASSERT_EQ(places.now().size(), 1U);
  EXPECT_NEAR(places.now()[0].at.x(), 0.02, 1e-3);
}

TEST(PressedPlaces, BeyondTheMostJoinTheNearest) {
  PressedPlaces places(0.001);
  for (std::size_t n = 0; n < PressedPlaces::most; ++n)
    EXPECT_TRUE(places.note(Vec3(0.01 * static_cast<double>(n), 0, 0), Vec3(0, 0, -1)));
  EXPECT_FALSE(places.note(Vec3(9, 0, 0), Vec3(0, 0, -1)));
  EXPECT_EQ(places.now().size(), PressedPlaces::most);
}

}  // namespace
}  // namespace palpate::physics
