// integrator = "auto" takes what is cheaper, says so, and is then the same as the integrator by its name.
#include "physics_node/forecast/integrator_choice.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/scene/load_scene.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/report/physics_summary.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A block of 8 cells on a side that sags under its weight.
Scene block(const std::string& integrator, double kPa, const std::string& material = "",
            const std::string& more = "", const std::string& model = "model = \"fem\"") {
  return parse_scene(fmt::format(R"(
[physics]
integrator = "{}"
frame_Hz = 100
[[body]]
name = "block"
shape = "box"
size_mm = [20, 20, 20]
lattice = "voxel"
spacing_mm = 2.5
fixed = ["+z"]
material = "tissue"
{}
[material.tissue]
density_kg_per_m3 = 1000
modulus_kPa = {}
{}
{}
)",
                                 integrator, model, kPa, material, more),
                     "s.toml");
}

Integrator taken(const Scene& scene) { return World(scene).scene().physics->integrator; }

std::uint64_t hash_after(const Scene& scene, int frames) {
  World world(scene);
  for (int n = 0; n < frames; ++n) world.frame({});
  return world.state_hash();
}

TEST(IntegratorChoice, TakesExplicitStepsWhereTheyAreFew) {
  const World soft(block("auto", 10));
  EXPECT_EQ(soft.scene().physics->integrator, Integrator::symplectic_euler);
  EXPECT_THAT(soft.remarks(), IsEmpty());
  EXPECT_EQ(hash_after(block("auto", 10), 5), hash_after(block("symplectic_euler", 10), 5));
}

TEST(IntegratorChoice, SolvesFramesThatWouldBeManySteps) {
  const World stiff(block("auto", 1000));
  EXPECT_EQ(stiff.scene().physics->integrator, Integrator::backward_euler);
  ASSERT_EQ(stiff.remarks().size(), 1u);
  EXPECT_THAT(stiff.remarks()[0], StartsWith("s.toml:2:1: \"auto\" takes \"backward_euler\" in place of "));
  EXPECT_EQ(stiff.step_seconds(), stiff.frame_seconds());
  EXPECT_EQ(hash_after(block("auto", 1000), 5), hash_after(block("backward_euler", 1000), 5));
  EXPECT_EQ(physics_summary(stiff, nullptr, 1)["integrator"], "backward_euler");
}

TEST(IntegratorChoice, TurnsAtTheMeasuredNumberOfSteps) {
  const Scene scene = block("auto", 10);
  const double at_limit = 1 / (100 * scene.physics->safety * worth_solving_cells);
  EXPECT_EQ(choose_integrator(scene, 1.01 * at_limit).integrator, Integrator::symplectic_euler);
  EXPECT_EQ(choose_integrator(scene, 0.99 * at_limit).integrator, Integrator::backward_euler);
  const Scene springs = block("auto", 10, "", "", "");
  EXPECT_EQ(choose_integrator(springs, 0.99 * at_limit).integrator, Integrator::symplectic_euler);
  EXPECT_EQ(choose_integrator(springs, 0.59 * at_limit).integrator, Integrator::backward_euler);
}

TEST(IntegratorChoice, StaysExplicitWhereASceneNeedsStepsAndSaysWhy) {
  struct Case {
    std::string material, more, why;
  };
  const std::string hand =
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 30], [1, 0, 0, 20]]\n";
  for (const Case& c :
       {Case{"relaxation = [[0.3, 0.1]]", "", "[material.tissue] relaxes"},
        Case{"law = \"green\"", "", "[material.tissue] has law = \"green\""},
        Case{"yield_ratio = 1.2\nk2_ratio = 0.1", "", "[material.tissue] yields"},
        Case{"break_ratio = 1.4", "", "[material.tissue] breaks"},
        Case{"", hand + "[[tool]]\nname = \"tip\"\ndevice = \"hand\"\n", "tool \"tip\" presses faces"},
        Case{"", hand + "[[tool]]\nname = \"rod\"\nshape = \"stick\"\nlength_mm = 40\ndevice = \"hand\"\n",
             "tool \"rod\" is a stick"}}) {
    const World world(block("auto", 1000, c.material, c.more));
    EXPECT_EQ(world.scene().physics->integrator, Integrator::symplectic_euler) << c.why;
    ASSERT_FALSE(world.remarks().empty()) << c.why;
    EXPECT_THAT(world.remarks()[0], HasSubstr("would be cheaper, since " + c.why));
  }
  const std::string nodes = hand + "[[tool]]\nname = \"tip\"\ncontact = \"nodes\"\ndevice = \"hand\"\n";
  EXPECT_EQ(taken(block("auto", 1000, "", nodes)), Integrator::backward_euler);
}

}  // namespace
}  // namespace palpate::physics
