// What the finite elements of a body are made of: its materials, cell by cell, and what they must share.
#include "physics_node/body/give_solid_elements.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* tissue =
    "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.4\nviscosity_Pa_s = 2\nrelaxation = "
    "[[0.3, 1]]";

/// 4 x 4 x 4 cells of 10 mm, the upper half of another material.
Recipe two_materials(const std::string& other) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material = tissue;
  recipe.body =
      "model = \"fem\"\nregions = [{ material = \"other\", box_min_mm = [-99, -99, 0], box_max_mm = [99, 99, "
      "99] }]\n"
      "[material.other]\n" +
      other;
  return recipe;
}

std::string refusal_of(const Recipe& recipe) {
  try {
    body_of(recipe);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(SolidElements, HaveTheModulusAndTheMassOfTheirOwnCell) {
  const Body body =
      body_of(two_materials("density_kg_per_m3 = 3000\nmodulus_kPa = 40\npoisson_ratio = 0.4\nviscosity_Pa_s "
                            "= 8\nrelaxation = [[0.3, 1]]"));
  const SolidElements& solid = *body.solid;
  EXPECT_DOUBLE_EQ(solid.modulus, 10e3);
  EXPECT_DOUBLE_EQ(solid.density, 1000);
  EXPECT_DOUBLE_EQ(solid.beta, 2e-4);
  EXPECT_NEAR(solid.largest_stiffness, 4.0 / 3, 1e-12) << "over density, as it bounds the step";
  int soft = 0, stiff = 0;
  double mass = 0;
  for (const Index cell : body.lattice.masses) {
    const float stiffness = solid.stiffness[static_cast<std::size_t>(cell)];
    if (stiffness == 1.0F) ++soft;
    if (stiffness == 4.0F) ++stiff;
    mass += solid.mass[static_cast<std::size_t>(cell)];
  }
  EXPECT_EQ(soft, 32);
  EXPECT_EQ(stiff, 32);
  EXPECT_NEAR(mass, 32e-6 * (1000 + 3000), 1e-12);
}

TEST(SolidElements, FollowTheIntensityOfTheImage) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({7, 2, 2}, [](int i, int, int) { return 50.F * static_cast<float>(i); }), path);
  BodySpec spec = volume_body(path, 0, 400);
  spec.model = ElementModel::fem;
  MaterialSpec scanned = soft_material();
  scanned.modulus_by_intensity = {{75, 4e3}, {175, 2e3}, {225, 12e3}};
  scanned.modulus = 2e3;
  const Body body = build_body(spec, std::vector<MaterialSpec>{scanned});
  // 0, 50: the first point; 100, 150 between it and the second; 200 between that and the third; 250, 300: the last.
  const std::array<double, 7> expected{4e3, 4e3, 3.5e3, 2.5e3, 7e3, 12e3, 12e3};
  for (const Index cell : body.lattice.masses) {
    const float stiffness = body.solid->stiffness[static_cast<std::size_t>(cell)];
    if (stiffness == 0) continue;
    const double x = body.lattice.rest_position(cell).x();  // of its lowest corner; the image is centred
    const auto i = static_cast<std::size_t>(std::lround(x / 0.002 + 3.5));
    ASSERT_LT(i, expected.size());
    EXPECT_NEAR(static_cast<double>(stiffness) * body.solid->modulus, expected[i], 1e-3) << i;
  }
  EXPECT_DOUBLE_EQ(body.solid->largest_stiffness, 6);
}

TEST(SolidElements, OfOneBodyShareWhatTheKernelHasOnce) {
  const auto with = [](const char* nu, const char* viscosity, const char* relaxation) {
    return refusal_of(
        two_materials(std::string("density_kg_per_m3 = 1000\nmodulus_kPa = 40\npoisson_ratio = ") + nu +
                      "\nviscosity_Pa_s = " + viscosity + "\n" + relaxation));
  };
  EXPECT_EQ(with("0.4", "8", "relaxation = [[0.3, 1]]"), "nothing");
  EXPECT_THAT(with("0.3", "8", "relaxation = [[0.3, 1]]"),
              AllOf(HasSubstr("poisson_ratio = 0.3"), HasSubstr("has 0.4")));
  EXPECT_THAT(with("0.4", "2", "relaxation = [[0.3, 1]]"), HasSubstr("viscosity over modulus is 5e-05 s"));
  for (const char* relaxation :
       {"", "relaxation = [[0.3, 2]]", "relaxation = [[0.2, 1]]", "relaxation = [[0.3, 1], [0.1, 9]]"})
    EXPECT_THAT(with("0.4", "8", relaxation), HasSubstr("\"other\" relaxes otherwise than \"m\""))
        << relaxation;
}

}  // namespace
}  // namespace palpate::physics
