// docs/reference/summary.md has every key that physics writes, and no other.
#include <gtest/gtest.h>

#include <set>

#include "common/scene/scene.h"
#include "physics_node/report/physics_summary.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/reference/page.h"

namespace palpate::physics {
namespace {

using namespace test;
using nlohmann::json;
using Keys = std::set<std::string>;

/// "stages.NAME.calls": what is named by the scene is called NAME.
void add_keys(Keys& keys, const json& part, const std::string& at) {
  if (!part.is_object()) {
    keys.insert(at);
    return;
  }
  const bool names = at == "stages" || at == "bodies" || at == "connections" || at == "tools" ||
                     at.ends_with("passed_unfelt_mm2");
  for (const auto& [key, value] : part.items())
    add_keys(keys, value, at + (at.empty() ? "" : ".") + (names ? "NAME" : key));
}

void add_keys(Keys& keys, const World& world, const Recorder* recorder) {
  add_keys(keys, physics_summary(world, recorder, 1.0), "");
}

/// A voxel slab pressed by a tool and recorded.
void add_pressed(Keys& keys) {
  const palpate::test::ScratchFolder folder;
  World world(pressed_slab());
  Recorder recorder(world, SceneSource{}, folder.path(), Recorder::WhenBehind::wait);
  const auto hand = steady_hand({0, 0, 1.5});
  run(world, hand, 1);
  recorder.frame(world, std::span(&hand, 1));
  add_keys(keys, world, &recorder);
}

/// Two brittle bodies, one of which breaks on the floor.
void add_broken(Keys& keys) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [0, 0, -3]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.05";
  recipe.world =
      floor_at(-21) +
      "[contact]\ncount_passages = true\n[[body]]\nname = \"other\"\nshape = \"sphere\"\nradius_mm = 20\n"
      "spacing_mm = 10\nmaterial = \"m\"\nat_mm = [500, 0, 0]\n";
  Scene scene = scene_of(recipe);
  World world(scene);
  for (int n = 0; n < 100; ++n) world.frame({});
  add_keys(keys, world, nullptr);
}

/// A step so far above the stable one that the scene is given up.
void add_given_up(Keys& keys) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 2e9";
  recipe.physics = "step_ms = 1";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.body = "fixed = [\"-z\"]";
  World world(scene_of(recipe));
  for (int n = 0; n < 500 && !world.stopped(); ++n) world.frame({});
  add_keys(keys, world, nullptr);
}

/// An implicit integrator has no stable step.
void add_implicit(Keys& keys) {
  Recipe recipe;
  recipe.physics = "integrator = \"backward_euler\"";
  World world(scene_of(recipe));
  world.frame({});
  add_keys(keys, world, nullptr);
}

/// A session that goes on where another was.
void add_of_finite_elements(Keys& keys) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  recipe.body = "model = \"fem\"";
  World world(scene_of(recipe));
  world.frame({});
  constexpr double began_t = 0.001;  // as if a record had been gone on from
  add_keys(keys, physics_summary(world, nullptr, 1.0, began_t), "");
}

/// Two bodies, what joins them, and a scalpel that goes through one of them.
void add_joined(Keys& keys) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  recipe.body = "model = \"fem\"";
  recipe.world =
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nshape = \"box\"\nsize_mm = [40, 40, "
      "40]\n"
      "spacing_mm = 10\nmaterial = \"m\"\nat_mm = [0, 0, 45]\n"
      "[[connection]]\nname = \"bed\"\nfrom = \"body\"\nto = \"other\"\nwithin_mm = 20\nmodulus_kPa = 1\n"
      "cut_toughness_J_per_m2 = 1\n"
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 0, -5], [1, -30, 0, -5]]\n";
  World world(scene_of(recipe));
  for (std::uint64_t n = 1; n < 60; ++n) {
    const std::optional<ToolState> hand =
        recorded_hand([](double t) { return Vec3(0.03 - t, 0, -0.005); }, n);
    world.frame(std::span(&hand, 1));
  }
  add_keys(keys, world, nullptr);
}

/// A tool that has cut and pierced.
void add_cut(Keys& keys) {
  World world(pressed_slab());
  world.tool(0).book().cut(1e-6, 1e-4);
  world.tool(0).book().closed(0.01, 1e-4);
  world.tool(0).book().pierced(0.01, 1e-4, 0.1);
  add_keys(keys, world, nullptr);
}

std::vector<palpate::test::Row> rows() {
  return palpate::test::rows_under(palpate::test::reference_page("docs/reference/summary.md"), "Physics");
}

TEST(SummaryReference, HasTheKeysThatPhysicsWritesAndNoOthers) {
  Keys written, listed;
  add_pressed(written);
  add_broken(written);
  add_given_up(written);
  add_of_finite_elements(written);
  add_cut(written);
  add_joined(written);
  for (const auto& row : rows()) {
    listed.insert(row.at("key"));
    EXPECT_NE(row.at("meaning"), "") << row.at("key");
  }
  EXPECT_EQ(listed, written);
}

/// "always" is in each of them.
TEST(SummaryReference, SaysWhatIsAlwaysThere) {
  Keys one, two, three, four;
  add_pressed(one);
  add_broken(two);
  add_given_up(three);
  add_implicit(four);
  for (const auto& row : rows()) {
    const auto& key = row.at("key");
    const bool always = one.contains(key) && two.contains(key) && three.contains(key) && four.contains(key);
    EXPECT_EQ(row.at("there") == "always", always) << key;
  }
}

}  // namespace
}  // namespace palpate::physics
