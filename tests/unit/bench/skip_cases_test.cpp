// Pairs of scenes that claim to differ in one thing have the same masses to move.
#include <gtest/gtest.h>

#include "bench/skips/measure_skip.h"
#include "bench/skips/skip_cases.h"
#include "common/scene/body_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/shape_spec.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::bench {
namespace {

TEST(Skips, CompareScenesOfTheSameMovingMasses) {
  const test::ScratchFolder folder;
  const auto cases = skip_cases(folder.path());
  ASSERT_GE(cases.size(), 5u);
  for (const SkipCase& c : cases) {
    const SceneCost lean = measure_scene(c.lean, 10, c.shaken), full = measure_scene(c.full, 10, c.shaken);
    EXPECT_EQ(lean.moving, full.moving) << c.skip;
    EXPECT_GT(lean.moving, 10000) << c.skip;
    EXPECT_GT(lean.us_per_frame, 0) << c.skip;
    EXPECT_EQ(full.asleep, 0) << c.skip;
    EXPECT_EQ(lean.asleep > 0, c.lean.physics->sleep) << c.skip;
  }
}

TEST(Skips, SayWhereASceneCannotBeBuilt) {
  const test::ScratchFolder folder;
  SkipCase c = skip_cases(folder.path()).back();
  std::get<VolumeShape>(c.lean.bodies[0].shape).file = folder / "nothing.h5";
  EXPECT_THROW(measure_scene(c.lean, 1, false), std::runtime_error);
}

}  // namespace
}  // namespace palpate::bench
