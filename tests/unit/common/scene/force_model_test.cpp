// Every shape, every word that a scene may or may not have, with and without torques.
#include "common/scene/force_model.h"

#include <gtest/gtest.h>

#include <array>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::test {
namespace {

using enum ForceModel;

struct Row {
  ToolShape shape;
  std::optional<ForceModel> asked;  // by the scene
  bool allowed;                     // there
  ForceModel physics;               // answers by it
  ForceModel with_torques, without;
  bool warns = false;  // without torques
};

constexpr std::array<Row, 20> table{{
    {ToolShape::point, std::nullopt, true, norton, norton, norton},
    {ToolShape::point, norton, true, norton, norton, norton},
    {ToolShape::point, tangent, false, tangent, tangent, tangent},
    {ToolShape::point, raw_planes, true, raw_planes, raw_planes, raw_planes},
    {ToolShape::point, direct, true, direct, direct, direct},
    {ToolShape::stick, std::nullopt, true, tangent, tangent, norton},
    {ToolShape::stick, norton, false, norton, norton, norton},
    {ToolShape::stick, tangent, true, tangent, tangent, norton, true},
    {ToolShape::stick, raw_planes, false, raw_planes, raw_planes, raw_planes},
    {ToolShape::stick, direct, true, direct, direct, direct},
    {ToolShape::body, std::nullopt, true, tangent, tangent, tangent},
    {ToolShape::body, norton, false, norton, norton, norton},
    {ToolShape::body, tangent, true, tangent, tangent, tangent},
    {ToolShape::body, raw_planes, false, raw_planes, raw_planes, raw_planes},
    {ToolShape::body, direct, true, direct, direct, direct},
    {ToolShape::body, tissue, false, tissue, tissue, tissue},
    {ToolShape::stick, tissue, true, tissue, tissue, tissue},
    {ToolShape::cylinder, std::nullopt, true, tissue, tissue, tissue},
    {ToolShape::cone, tissue, true, tissue, tissue, tissue},
    {ToolShape::box, direct, false, tissue, tissue, tissue},
}};

TEST(ForceModel, IsDecidedByShapeSceneAndTorques) {
  for (std::size_t n = 0; n < table.size(); ++n) {
    SCOPED_TRACE(n);
    const Row& row = table[n];
    ToolSpec tool;
    tool.shape = row.shape;
    tool.force_model = row.asked;
    const ForceModel word = row.asked.value_or(row.physics);
    EXPECT_EQ(can_feel(row.shape, word), row.allowed);
    EXPECT_EQ(force_model_of(tool), row.physics);
    const ForceModelChoice with = felt_force_model(tool, 0.02), without = felt_force_model(tool, 0);
    EXPECT_EQ(with.model, row.with_torques);
    EXPECT_EQ(without.model, row.without);
    EXPECT_EQ(felt_force_model(tool, -1).model, row.without) << "no torque is less than none";
    // No change is silent: the words say that torques lack, and a scene that names the model is warned.
    EXPECT_FALSE(with.lacks_torques);
    EXPECT_EQ(without.lacks_torques, row.without != row.with_torques);
    EXPECT_EQ(words_of(without).find("torques") != std::string::npos, without.lacks_torques);
    EXPECT_EQ(words_of(without).rfind(word_of(row.without), 0), 0U);
    EXPECT_TRUE(warning_of(with).empty());
    EXPECT_EQ(!warning_of(without).empty(), row.warns);
    // Physics does not know the device. It may not have to: `direct` and `raw_planes` are never put in place of another.
    for (const ForceModel felt : {with.model, without.model})
      for (const ForceModel own : {direct, raw_planes}) EXPECT_EQ(felt == own, row.physics == own);
  }
}

/// What a point feels where its scene does not say.
TEST(ForceModel, OfAPointIsTissueWhereFacesOfElementsBear) {
  const auto model_of = [](const std::string& body, const std::string& tool,
                           const std::string& physics = "") {
    const Scene scene = parse_scene(
        "title = \"t\"\n" + physics +
            "[material.m]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 10\n[[body]]\nname = \"b\"\nlattice = "
            "\"voxel\"\nspacing_mm = 4\n"
            "shape = \"box\"\nsize_mm = [20, 20, 20]\nfixed = [\"-z\"]\nmaterial = \"m\"\n" +
            body + "\n[[tool]]\nname = \"tip\"\ndevice = \"hand\"\n" + tool +
            "\n[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n",
        "t");
    return force_model_of(scene.tools[0]);
  };
  const std::string fem = "model = \"fem\"";
  EXPECT_EQ(model_of(fem, ""), tissue);
  EXPECT_EQ(model_of(fem, "", "[physics]\nintegrator = \"auto\"\n"), tissue);
  EXPECT_EQ(model_of(fem, "friction = 0.3"), tissue);
  EXPECT_EQ(model_of(fem, "force_model = \"norton\""), norton);
  EXPECT_EQ(model_of(fem, "contact = \"nodes\""), norton);
  EXPECT_EQ(model_of(fem, "radius_mm = 1.9"), norton) << "cells are too coarse for its faces";
  EXPECT_EQ(model_of(fem, "", "[physics]\nintegrator = \"backward_euler\"\n"), norton);
  EXPECT_EQ(model_of("", ""), norton) << "springs, as the papers have them";
  EXPECT_EQ(model_of(fem, "shape = \"stick\"\nlength_mm = 40"), tangent);
}

}  // namespace
}  // namespace palpate::test
