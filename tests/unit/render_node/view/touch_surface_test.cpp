// Over which surface the mouse leads a tool.

#include "render_node/view/touch_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "common/scene/scene.h"
#include "render_node/model/view_model.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

constexpr double side = 0.1;
constexpr int cells = 12;
const auto cube = test::cube_surface(cells, side, 0xff96b4e6U);

struct Seen {
  Seen() : scene(test::small_scene()), model(scene), camera(test::camera_of_cube(scene, side)) {
    for (const auto& chunk : test::chunks_of(cube, 0, 1)) model.take(chunk);
  }
  Scene scene;
  ViewModel model;
  Camera camera;  // looks along +y
};

const Eigen::Vector2d middle(160, 120), corner(2, 2);

TEST(TouchSurface, IsHalfAnEdgeAndWhatIsAskedForBeforeTheNearestFace) {
  Seen seen;
  TouchSurface touch;
  EXPECT_FALSE(touch.under(seen.camera, middle, 0)) << "nothing is kept yet";
  touch.keep(seen.model.bodies(), {});
  for (const double aside : {0.0, 40.0}) {
    const Eigen::Vector2d pixel = middle + Eigen::Vector2d(aside, 0);
    const auto p = touch.under(seen.camera, pixel, 0.003);
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->y(), -side / 2 - side / cells / 2 - 0.003, 1e-8);
    EXPECT_LT((*seen.camera.project(*p) - pixel).norm(), 1e-6);
  }
  EXPECT_FALSE(touch.under(seen.camera, corner, 0));
}

TEST(TouchSurface, DoesNotSeeTheDentThatTheToolMakes) {
  Seen seen;
  TouchSurface touch;
  touch.keep(seen.model.bodies(), {});
  const auto before = touch.under(seen.camera, middle, 0);
  auto block = std::make_unique<VertexBlock>(test::block_of(cube, 0, 1, 0));
  for (auto& p : block->position) p[1] += 0.02F;
  seen.model.take(*block);
  EXPECT_EQ(*touch.under(seen.camera, middle, 0), *before);
  EXPECT_NEAR(touch.under(seen.camera, middle + Eigen::Vector2d(1, 0), 0)->y(), before->y(), 1e-8);
  touch.keep(seen.model.bodies(), {});
  EXPECT_NEAR(touch.under(seen.camera, middle, 0)->y(), before->y() + 0.02, 1e-6) << "taken anew it does";
}

TEST(TouchSurface, LooksThroughWhatIsHiddenAndFollowsTheCamera) {
  Seen seen;
  TouchSurface touch;
  touch.keep(seen.model.bodies(), {true});
  EXPECT_FALSE(touch.under(seen.camera, middle, 0));
  touch.keep(seen.model.bodies(), {false});
  ASSERT_TRUE(touch.under(seen.camera, middle, 0));
  seen.camera.look_from(1.5707963267948966, 0);
  seen.camera.fit({Vec3::Constant(-side / 2), Vec3::Constant(side / 2)});
  EXPECT_NEAR(touch.under(seen.camera, middle, 0)->x(), side / 2 + side / cells / 2, 1e-8);
}

TEST(TouchSurface, DoesNotMeetWhatASectionTakesAway) {
  Seen seen;
  TouchSurface touch;
  touch.keep(seen.model.bodies(), {}, section_cut({1, 0.0}, seen.camera.eye()));
  const auto behind = touch.under(seen.camera, middle, 0);
  ASSERT_TRUE(behind) << "the far side";
  EXPECT_NEAR(behind->y(), side / 2 - side / cells / 2, 1e-8);
  // The cut face itself is in the way.
  touch.keep(seen.model.bodies(), {}, section_cut({1, 0.0}, seen.camera.eye()));
  touch.keep_sections(seen.model.bodies());
  EXPECT_FALSE(touch.under(seen.camera, middle, 0));
}

}  // namespace
}  // namespace palpate::render
