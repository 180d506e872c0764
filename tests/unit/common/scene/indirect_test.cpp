// A value that is kept elsewhere behaves as a member would.
#include "common/scene/indirect.h"

#include <gtest/gtest.h>

#include <string>

#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate::test {
namespace {

TEST(Indirect, IsCopiedWithItsOwner) {
  Scene scene;
  scene.physics->threads = 3;
  Scene copy = scene;
  copy.physics->threads = 5;
  EXPECT_EQ(scene.physics->threads, 3);
  scene = copy;
  EXPECT_EQ(scene.physics->threads, 5);
  scene.physics->threads = 7;
  EXPECT_EQ(copy.physics->threads, 5) << "assigned, not shared";
}

TEST(Indirect, CanBeAssignedToItselfAndAfterAMove) {
  Indirect<std::string> text("one");
  const Indirect<std::string>& same = text;
  text = same;
  EXPECT_EQ(*text, "one");
  const Indirect<std::string> taken = std::move(text);
  EXPECT_EQ(*taken, "one");
  text = taken;
  EXPECT_EQ(*text, "one");
  text = std::string("two");
  EXPECT_EQ(text->size(), 3U);
  EXPECT_EQ(*taken, "one");
}

TEST(Indirect, StartsAsItsTypeDoes) {
  EXPECT_EQ(*Indirect<std::string>(), "");
  EXPECT_EQ(Scene().physics->frame_Hz, PhysicsSpec().frame_Hz);
}

}  // namespace
}  // namespace palpate::test
