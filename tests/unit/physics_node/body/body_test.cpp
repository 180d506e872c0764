#include "physics_node/body/body.h"

#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

Recipe voxel_box(const std::string& fixed) {  // 4 x 4 x 4 cells, 5 x 5 x 5 masses
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.body = fixed;
  return recipe;
}

TEST(HeldMasses, AreThoseOnTheFacesNamed) {
  EXPECT_EQ(body_of(voxel_box("")).n_held, 0);
  EXPECT_EQ(body_of(voxel_box("fixed = [\"-z\"]")).n_held, 25);
  EXPECT_EQ(body_of(voxel_box("fixed = [\"-z\", \"+x\"]")).n_held, 45);
  const Body body = body_of(voxel_box("fixed = [\"+y\"]"));
  for (const Index cell : body.lattice.masses) {
    const bool held = body.inverse_mass[static_cast<std::size_t>(cell)] == 0;
    EXPECT_EQ(held, body.lattice.rest_position(cell).y() > 0.019);
  }
}

TEST(HeldMasses, AreThoseInTheBoxesGiven) {
  const Body body = body_of(voxel_box("fixed = [{ min_mm = [-1, -1, -1], max_mm = [11, 1, 1] }]"));
  EXPECT_EQ(body.n_held, 2);  // at (0, 0, 0) and (10, 0, 0) mm
}

TEST(HeldMasses, AreThoseThatTouchTheScenery) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({9, 9, 9}, [](int, int, int) { return 100.F; }), path);
  BodySpec spec = volume_body(path, 50, 200);
  std::get<VolumeShape>(spec.shape).deformable = {false, {4, 4, 4}, 2};
  const Body body = build_body(spec, soft_material());
  EXPECT_EQ(body.lattice.n_masses(), 6 * 6 * 6);
  EXPECT_EQ(body.n_held, 6 * 6 * 6 - 4 * 4 * 4);
  EXPECT_LT((body.lattice.origin - Vec3::Constant(-0.005)).norm(), 1e-12);
}

TEST(Mass, OfABodyIsThatOfItsTissue) {
  Recipe recipe = voxel_box("");
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20";
  const Body body = body_of(recipe);
  EXPECT_NEAR(body.law.mass * body.lattice.n_masses(), 1000 * 0.04 * 0.04 * 0.04, 1e-12);
}

TEST(Body, NeedsTwoMasses) {
  Recipe recipe;
  recipe.shape = Recipe::sphere(5);
  EXPECT_THROW(body_of(recipe), InputError);
}

}  // namespace
}  // namespace palpate::physics
