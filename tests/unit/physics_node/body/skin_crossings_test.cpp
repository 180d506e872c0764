#include "physics_node/body/skin_crossings.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/physics/smooth_image.h"

namespace palpate::physics {
namespace {

using namespace test;

/// A row of five cells; the outer ones are what is asked about.
std::map<int, double> along_x(const std::array<float, 5>& row, double lo, double hi,
                              const std::vector<CavitySpec>& cavities = {}) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "row.h5";
  write_volume(made_volume({5, 1, 1}, [&](int i, int, int) { return row[static_cast<std::size_t>(i)]; }),
               path);
  BodySpec spec = volume_body(path, lo, hi);
  spec.border.skin = SkinKind::smooth;
  spec.cavities = cavities;
  std::map<int, double> found;  // by 6 cell + face
  for (const SkinCrossing& c : make_cells(spec).crossings)
    if (c.face % 6 < 2) found[static_cast<int>(c.face)] = c.share;
  return found;
}

TEST(SkinCrossings, LieWhereTheIntensityLeavesTheWindow) {
  // 100 is 50 within, 20 is 30 without: 5/8 of the way. 400 to 700 leaves 500 after a third.
  const auto found = along_x({20, 100, 300, 400, 700}, 50, 500);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found.at(6 * 1 + 0), 50.0 / 80, 1e-12);
  EXPECT_NEAR(found.at(6 * 3 + 1), 100.0 / 300, 1e-12);
}

TEST(SkinCrossings, EndAtTheFaceOfTheImage) {
  const auto found = along_x({100, 100, 100, 100, 100}, 50, 500);
  EXPECT_EQ(found.at(0), 0.5);
  EXPECT_EQ(found.at(6 * 4 + 1), 0.5);
}

TEST(SkinCrossings, NeverFallOnACentre) {
  const auto found = along_x({0, 50, 100, 50, 0}, 50, 500);
  EXPECT_EQ(found.at(6 * 1 + 0), least_crossing);
}

TEST(SkinCrossings, LieOnTheWallOfACavity) {
  // Cells are 2 mm, and their centres at -4, -2, 0, 2, 4 mm: the ball takes the middle one and reaches 1.3 mm.
  CavitySpec cavity;
  cavity.where = BallRegion{Vec3::Zero(), 0.0013};
  const auto found = along_x({100, 100, 100, 100, 100}, 50, 500, {cavity});
  EXPECT_NEAR(found.at(6 * 1 + 1), 0.7 / 2, 1e-6);
  EXPECT_NEAR(found.at(6 * 3 + 0), 0.7 / 2, 1e-6);
}

TEST(SkinCrossings, AreNoneOfBricks) {
  SmoothImage image;
  image.skin = SkinKind::bricks;
  EXPECT_TRUE(image.body().cells->crossings.empty());
}

}  // namespace
}  // namespace palpate::physics
