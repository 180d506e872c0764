// Tissue that the hand's motion presses: it bears what spring and damper say, whenever messages come, and lets go when the hand does.

#include "physics_node/contact/tissue_tool.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/error/error.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/recorded_hand.h"

namespace palpate::physics::test {
namespace {

Recipe palpated_slab(double frame_Hz, const std::string& model = "fem") {
  Recipe recipe = pressed_slab_recipe();
  recipe.body += "\nmodel = \"" + model + "\"";
  recipe.physics = "frame_Hz = " + std::to_string(frame_Hz);
  const std::string shape = "shape = \"point\"";
  recipe.world.insert(recipe.world.find(shape) + shape.size(), "\nforce_model = \"tissue\"");
  return recipe;
}

/// In the air for 50 ms, then down to 2 mm, and 0.5 mm to and fro at 5 Hz until 0.65 s; then away.
Vec3 palpation(double t) {
  const double in = 1e-3 * (-1 + 3 * std::clamp((t - 0.05) / 0.1, 0.0, 1.0));
  const double swing = t > 0.15 ? 0.5e-3 * std::sin(2 * M_PI * 5 * (t - 0.15)) : 0;
  return {0.0005, 0.0005, slab_top - in - swing + (t > 0.65 ? 0.2 * (t - 0.65) : 0)};
}

struct Session {
  explicit Session(const Recipe& recipe) : world(scene_of(recipe)) {}
  /// A frame at whose end this sample of the hand is played.
  const TouchedTissue& to(std::uint64_t sample, const std::function<Vec3(double)>& path = palpation) {
    std::optional<ToolState> hand = recorded_hand(path, sample);
    world.frame(std::span(&hand, 1));
    world.tool(0).write_patch(patch, 1, 0);
    return patch.tissues[0];
  }
  Vec3 borne() const { return world.tool(0).borne(); }

  World world;
  ContactPatch patch;
};

double depth_told(const TouchedTissue& told) {
  double z = told.rest + told.residual * told.force;
  for (std::uint32_t i = 0; i < told.n_modes; ++i) z += told.modes[i].phi * told.modes[i].q;
  return z;
}

TEST(TissueTool, BearsWhatTheSpringOfTheHandPressesWith) {
  for (const char* model : {"fem", "springs"}) {
    Session session(palpated_slab(1000, model));
    const auto held = [](double t) { return palpation(std::min(t, 0.15)); };
    for (std::uint64_t n = 1; n <= 600; ++n) session.to(n, held);
    const TouchedTissue& told = session.patch.tissues[0];
    ASSERT_EQ(session.patch.n_tissues, 1u);
    EXPECT_EQ(told.sample, 600u);
    EXPECT_GT(told.force, 0.1) << model;
    EXPECT_NEAR(session.borne().z(), told.force, 1e-9 + 1e-3 * told.force)
        << "on the tool, out of the tissue";
    EXPECT_NEAR(total(forces_of_tool(session.world)).z(), -told.force, 1e-6 + 1e-3 * told.force);
    const double x = vec(told.normal).dot(vec(told.point) - held(1));
    EXPECT_NEAR(told.force, 500 * (x - depth_told(told)), 0.005 * told.force) << "K (x - z), at rest";
    EXPECT_EQ(told.n_modes, std::string(model) == "fem" ? 9u : 0u);
  }
}

/// In the hand's own time: the same force at the same sample, however seldom physics steps.
TEST(TissueTool, BearsTheSameForceAtASampleAtAnyRate) {
  Session often(palpated_slab(1000)), seldom(palpated_slab(20));
  double off2 = 0, all2 = 0;
  for (std::uint64_t n = 1; n <= 650; ++n) {
    const double force = often.to(n).force;
    if (n % 50 != 0 || n < 100) continue;
    const double other = seldom.to(n).force;
    off2 += (force - other) * (force - other), all2 += force * force;
  }
  EXPECT_GT(all2, 0.1);
  EXPECT_LT(std::sqrt(off2 / all2), 0.03);
}

TEST(TissueTool, BearsNothingFromTheFirstSampleThatIsClear) {
  Session session(palpated_slab(1000));
  std::uint64_t n = 1;
  double most = 0;
  for (; n < 650 || palpation(1e-3 * static_cast<double>(n)).z() < slab_top + 1e-4; ++n)
    most = std::max<double>(most, session.to(n).force);
  EXPECT_GT(most, 0.1);
  for (const std::uint64_t end = n + 200; n < end; ++n) {
    session.to(n);
    ASSERT_EQ(session.borne(), Vec3(Vec3::Zero())) << n;
  }
}

/// From far above, where no face is listed, to contact: what is told is a number all the way.
TEST(TissueTool, TellsOfTissueOnlyWhereItKnowsWhereItIs) {
  Session session(palpated_slab(1000));
  int told = 0;
  for (std::uint64_t n = 1; n <= 400; ++n) {
    const TouchedTissue& tissue =
        session.to(n, [](double t) { return Vec3(0, 0, slab_top + 0.03 - 0.08 * t); });
    if (session.patch.n_tissues == 0) continue;
    ++told;
    ASSERT_TRUE(std::isfinite(tissue.rest)) << n;
    if (tissue.force > 0) continue;
    EXPECT_NEAR(vec(tissue.point).z() - depth_told(tissue), slab_top, 3e-4) << n;
  }
  EXPECT_GT(told, 50);
}

TEST(TissueTool, LetsGoOfTissueWhereTheHandIsSilent) {
  Session session(palpated_slab(1000));
  for (std::uint64_t n = 1; n <= 300; ++n) session.to(n);
  double before = session.borne().z();
  ASSERT_GT(before, 0.1);
  run(session.world, std::nullopt, 50);
  EXPECT_LT(session.borne().z(), before) << "a quarter is gone";
  EXPECT_GT(session.borne().z(), 0.3 * before);
  run(session.world, std::nullopt, 160);
  EXPECT_EQ(session.borne().z(), 0);
}

/// A hand whose forces are off presses nothing, nor one that feels none.
TEST(TissueTool, IsNotPressedByAHandThatFeelsNothing) {
  for (const bool engaged : {false, true}) {
    World world(scene_of(palpated_slab(1000)));
    for (std::uint64_t n = 1; n <= 300; ++n) {
      std::optional<ToolState> hand = recorded_hand(palpation, n);
      hand->engaged = engaged ? 1 : 0;
      if (engaged) hand->force_limit = 0;
      world.frame(std::span(&hand, 1));
      ASSERT_TRUE(forces_of_tool(world).empty());
    }
  }
}

TEST(TissueTool, RefusesCellsThatAreTooCoarse) {
  Recipe recipe = palpated_slab(1000);
  recipe.spacing_mm = 12;
  EXPECT_THROW(World{scene_of(recipe)}, InputError);
}

TEST(TissueTool, BeginsAnewAfterAReset) {
  Session session(palpated_slab(1000));
  for (std::uint64_t n = 1; n <= 200; ++n) session.to(n);
  session.world.reset();
  EXPECT_EQ(session.borne(), Vec3(Vec3::Zero()));
  EXPECT_EQ(session.to(1).force, 0) << "from outside again";
}

}  // namespace
}  // namespace palpate::physics::test
