#include "render_node/model/section_control.h"

#include <gtest/gtest.h>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "render_node/view/section_cut.h"

namespace palpate::render {
namespace {

Scene scene_of(LatticeKind lattice) {
  Scene scene;
  BodySpec body;
  body.name = "block";
  body.lattice = lattice;
  scene.bodies.push_back(body);
  return scene;
}

const Eigen::AlignedBox3d box(Vec3(-1, -2, -3), Vec3(1, 4, 5));

TEST(SectionControl, GoesRoundTheAxes) {
  SectionControl control(scene_of(LatticeKind::voxel));
  EXPECT_TRUE(control.applies());
  EXPECT_FALSE(control.value());
  for (int axis = 0; axis < 3; ++axis) {
    control.next(box);
    ASSERT_TRUE(control.value());
    EXPECT_EQ(*control.value(), (SectionSpec{axis, box.center()[axis]}));
  }
  control.next(box);
  EXPECT_FALSE(control.value());
}

TEST(SectionControl, StaysInTheBoxAndRemembersEachAxis) {
  SectionControl control(scene_of(LatticeKind::voxel));
  control.move(5, box);  // none: nothing to move
  EXPECT_FALSE(control.value());
  control.choose(1, box);
  control.move(10, box);
  EXPECT_DOUBLE_EQ(control.value()->at, 1.6);
  control.move_to(99, box);
  EXPECT_DOUBLE_EQ(control.value()->at, 4);
  control.choose(2, box);
  control.choose(1, box);
  EXPECT_DOUBLE_EQ(control.value()->at, 4);
}

TEST(SectionControl, CommandsWhatIsNewAndNotTooOften) {
  SectionControl control(scene_of(LatticeKind::voxel));
  EXPECT_FALSE(control.due(0, true));
  control.choose(0, box);
  EXPECT_TRUE(control.due(1, false));
  EXPECT_FALSE(control.due(2, false));
  control.move(1, box);
  EXPECT_FALSE(control.due(1.1, false));
  EXPECT_TRUE(control.due(1.1, true));
  control.obey(SectionSpec{2, 0.5});
  EXPECT_FALSE(control.due(9, true));
  control.close();
  EXPECT_TRUE(control.due(9, true));
}

TEST(SectionControl, IsOfCells) {
  EXPECT_FALSE(SectionControl(scene_of(LatticeKind::fcc)).applies());
  Scene scene = scene_of(LatticeKind::voxel);
  scene.render->section = SectionSpec{1, 0.25};
  EXPECT_EQ(SectionControl(scene).value(), (SectionSpec{1, 0.25}));
}

TEST(SectionCut, TakesAwayTheSideOfTheEye) {
  const SectionSpec section{1, 0.5};
  EXPECT_TRUE(is_cut_away(section_cut(section, Vec3(0, 3, 0)), {0, 0.6F, 0}));
  EXPECT_FALSE(is_cut_away(section_cut(section, Vec3(0, 3, 0)), {9, 0.4F, 9}));
  EXPECT_TRUE(is_cut_away(section_cut(section, Vec3(0, -3, 0)), {9, 0.4F, 9}));
  EXPECT_FALSE(is_cut_away(section_cut(section, Vec3(0, -3, 0)), {9, 0.6F, 9}));
  EXPECT_FALSE(is_cut_away(no_cut(), {9, 9, 9}));
}

TEST(SectionCommand, HasAName) {
  EXPECT_EQ(section_of("y", 0.5), (SectionSpec{1, 0.5}));
  EXPECT_EQ(section_of("none", 0.5), std::nullopt);
  EXPECT_EQ(section_of("", 0), std::nullopt);
  EXPECT_EQ(section_of("xx", 0), std::nullopt);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(section_of(section_name(SectionSpec{axis, 1}), 1), (SectionSpec{axis, 1}));
  EXPECT_EQ(section_name(std::nullopt), "none");
}

}  // namespace
}  // namespace palpate::render
