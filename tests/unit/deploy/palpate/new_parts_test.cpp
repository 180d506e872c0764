// What palpate new is made of: the threshold of air, a place to touch, the region that moves, and the text.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "deploy/palpate/air_threshold.h"
#include "deploy/palpate/press_plan.h"
#include "deploy/palpate/scene_draft.h"
#include "deploy/palpate/touch_place.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

using physics::Cells;

/// So many values round each mean.
struct Heap {
  int count;
  double mean, deviation;
};
std::vector<float> values_of(const std::vector<Heap>& heaps) {
  std::mt19937 random(7);
  std::vector<float> values;
  for (const Heap& heap : heaps) {
    std::normal_distribution<double> normal(heap.mean, heap.deviation);
    for (int n = 0; n < heap.count; ++n) values.push_back(static_cast<float>(normal(random)));
  }
  return values;
}

TEST(AirThreshold, LiesHalfwayBetweenTwoClasses) {
  const auto found = air_threshold(values_of({{7000, 100, 3}, {3000, 900, 3}}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->intensity, 500, 5);
  EXPECT_NEAR(found->air, 100, 3);
}

/// Neither bone and metal nor what lies below air pull it.
TEST(AirThreshold, OfCtLiesBetweenAirAndSoftTissue) {
  const auto found = air_threshold(values_of(
      {{20000, -3024, 0.1}, {30000, -1000, 20}, {30000, 30, 40}, {6000, 1400, 300}, {300, 20000, 900}}));
  ASSERT_TRUE(found);
  EXPECT_GT(found->intensity, -600);
  EXPECT_LT(found->intensity, -350);
}

/// Air is a hundredth of the image only.
TEST(AirThreshold, FindsLittleAir) {
  const auto found = air_threshold(values_of({{600, -1000, 20}, {50000, 30, 60}, {6000, 900, 200}}));
  ASSERT_TRUE(found);
  EXPECT_GT(found->intensity, -700);
  EXPECT_LT(found->intensity, -300);
}

TEST(AirThreshold, KeepsDimTissueOfABrightImage) {
  const auto found =
      air_threshold(values_of({{50000, 12, 6}, {15000, 150, 30}, {15000, 300, 40}, {9000, 600, 60}}));
  ASSERT_TRUE(found);
  EXPECT_GT(found->intensity, 40);
  EXPECT_LT(found->intensity, 130);
}

TEST(AirThreshold, IsNoneWhereAllIsOne) {
  EXPECT_FALSE(air_threshold(values_of({{9000, 300, 40}})));
  std::vector<float> whole = values_of({{9000, 3, 4}, {9000, 3, 20}});
  for (float& value : whole) value = std::trunc(value);
  EXPECT_FALSE(air_threshold(whole));
  EXPECT_FALSE(air_threshold(std::vector<float>(1000, 4.0F)));
  EXPECT_FALSE(air_threshold({}));
}

TEST(AirThreshold, SplitsLabels) {
  std::vector<float> labels(1000, 0.0F);
  std::fill(labels.begin(), labels.begin() + 50, 255.0F);
  const auto found = air_threshold(labels);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->intensity, 127.5, 1);
}

/// Cells of 1 mm round the origin.
Cells cells_of(const Vec3i& size, const std::function<bool(const Vec3&)>& is_tissue) {
  Cells cells;
  cells.size = size;
  cells.spacing = Vec3::Constant(1e-3);
  cells.corner = -0.5e-3 * size.cast<double>();
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) cells.filled.push_back(is_tissue(cells.centre_of(i, j, k)) ? 1 : 0);
  return cells;
}
Cells ball() {
  return cells_of({60, 60, 60}, [](const Vec3& p) { return p.norm() < 0.02; });
}

TEST(TouchPlace, OfABallIsOnItAndLooksOutward) {
  const auto place = best_place(ball(), 2e-3);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->at.norm(), 0.02, 1e-3);
  EXPECT_GT(place->outward.dot(place->at.normalized()), 0.98);
  EXPECT_NEAR(place->thickness, most_looked_through(2e-3), 2e-4);
}

/// Of an oblique plane the steps of the cells say nothing of the normal.
TEST(TouchPlace, KnowsTheNormalOfAnObliquePlane) {
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  const Cells cells = cells_of({60, 60, 60}, [&](const Vec3& p) { return p.dot(normal) < 0; });
  const auto place = place_near(cells, Vec3(0.001, 0.002, -0.004), 2e-3);
  ASSERT_TRUE(place);
  EXPECT_GT(place->outward.dot(normal), std::cos(0.07));
  EXPECT_NEAR(place->at.dot(normal), 0, 1e-3);
}

/// Tissue that fills the image to its end on a side was cut there; a hole that is too narrow is no way in.
TEST(TouchPlace, IsNeitherACutNorAHole) {
  const Cells half = cells_of({40, 40, 40}, [](const Vec3& p) { return p.x() < 0.005; });
  const auto place = best_place(half, 2e-3);
  ASSERT_TRUE(place);
  EXPECT_GT(place->outward.x(), 0.99);
  const Cells holed =
      cells_of({60, 60, 60}, [](const Vec3& p) { return p.norm() < 0.02 && p.norm() > 0.006; });
  const auto out = place_near(holed, Vec3::Zero(), 2e-3);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->at.norm(), 0.02, 1e-3);
  EXPECT_FALSE(best_place(cells_of({9, 9, 9}, [](const Vec3&) { return true; }), 2e-3));
  EXPECT_FALSE(place_near(cells_of({9, 9, 9}, [](const Vec3&) { return true; }), Vec3::Zero(), 2e-3));
}

ImageTissue tissue_of_ball() {
  ImageTissue tissue;
  tissue.keep = {0.5, 2};
  tissue.partition = {60, 60, 60};
  tissue.cells = ball();
  tissue.tip_radius = 2e-3;
  return tissue;
}

TEST(PressPlan, LeavesTissueThatHoldsWhatIsAwake) {
  const ImageTissue tissue = tissue_of_ball();
  const TouchPlace place = *best_place(tissue.cells, tissue.tip_radius);
  const PressPlan plan = plan_press(tissue, place, "v.h5");
  EXPECT_GT(plan.n_awake, 100);
  EXPECT_LT(static_cast<std::size_t>(plan.n_awake), tissue.cells.n_filled());
  EXPECT_GT(plan.real_time_factor, 1);
  EXPECT_NEAR((plan.path[1].p - place.at).norm(), 0, 1e-12);
  EXPECT_NEAR((plan.path[2].p - place.at).norm(), plan.depth, 1e-12);
}

TEST(PressPlan, TakesLessOfSmallerCellsToKeepPace) {
  ImageTissue tissue = tissue_of_ball();
  TouchPlace place = *best_place(tissue.cells, tissue.tip_radius);
  const double of_a_millimetre = plan_press(tissue, place, "v.h5").awake / 1e-3;
  tissue.cells.spacing *= 3;
  tissue.cells.corner *= 3;
  place.at *= 3;
  EXPECT_GT(plan_press(tissue, place, "v.h5").awake / 3e-3, of_a_millimetre);
}

TEST(PressPlan, HoldsTheTissueThatLiesOpposite) {
  const ImageTissue tissue = tissue_of_ball();
  const TouchPlace place = *best_place(tissue.cells, tissue.tip_radius);
  const PressPlan plan = plan_press(tissue, place, "v.h5");
  EXPECT_FALSE(plan.held.contains(place.at));
  EXPECT_LT(plan.held.center().dot(place.outward), 0);
  int held = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i)
        held += tissue.cells.is_filled(i, j, k) &&
                plan.held.contains(tissue.cells.corner +
                                   tissue.cells.spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5)));
  EXPECT_GT(held, 50);
  EXPECT_LT(held, 0.2 * static_cast<double>(tissue.cells.n_filled()));
}

TEST(PressPlan, RefusesWhatNothingWouldHold) {
  ImageTissue tissue = tissue_of_ball();
  tissue.cells = cells_of({20, 20, 20}, [](const Vec3& p) { return p.norm() < 0.0019; });
  const auto place = place_near(tissue.cells, Vec3(0, 0, 0.002), 1e-3);
  ASSERT_TRUE(place);
  EXPECT_THROW(plan_press(tissue, *place, "v.h5"), InputError);
}

TEST(SceneDraft, ReadsBackAsPlannedWhateverTheFileIsCalled) {
  const ImageTissue tissue = tissue_of_ball();
  const TouchPlace place = *best_place(tissue.cells, tissue.tip_radius);
  const PressPlan plan = plan_press(tissue, place, "v.h5");
  const test::TemporaryFolder folder;
  for (const std::string file : {"v.h5", "a \"b\"\\\n#c.h5", "K\xc3\xb6pf'e.h5"}) {
    folder.write(file, "");
    const Scene scene =
        parse_scene(scene_draft(file, "words", tissue, place, plan), (folder / "s.toml").string());
    const auto& shape = std::get<VolumeShape>(scene.bodies[0].shape);
    EXPECT_EQ(shape.file, (folder / file).string());
    ASSERT_TRUE(shape.deformable.awake);
    EXPECT_NEAR(*shape.deformable.awake, plan.awake, 1e-6);
    ASSERT_EQ(scene.devices[0].waypoints.size(), plan.path.size());
    for (std::size_t n = 0; n < plan.path.size(); ++n)
      EXPECT_NEAR((scene.devices[0].waypoints[n].p - plan.path[n].p).norm(), 0, 1e-7);
    EXPECT_GE(*scene.seconds, plan.path.back().t);
  }
}

TEST(SceneDraft, NamesAFileFromTheFolderOfTheScene) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "data");
  std::filesystem::create_directories(folder / "scenes");
  folder.write("data/v.h5", "");
  const auto named = [&](const std::string& scene) {
    return named_from((folder / "data/v.h5").string(), (folder / scene).string());
  };
  EXPECT_EQ(named("scenes/s.toml"), "../data/v.h5");
  EXPECT_EQ(named("data/s.toml"), "v.h5");
  std::filesystem::create_directory_symlink(folder / "scenes", folder / "data" / "link");
  EXPECT_TRUE(std::filesystem::exists((folder / "data/link" / named("data/link/s.toml")).lexically_normal()));
}

}  // namespace
}  // namespace palpate::deploy
