// Runs under a virtual display (CMakeLists.txt).
#include "render_node/ui/window.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/error/error.h"
#include "tests/unit/render_node/render_support.h"
// Last: Xlib's macros.
#include "tests/unit/render_node/ui/window_hand.h"

namespace palpate::render {
namespace {

TEST(Window, ShowsTheBodyAndThePanels) {
  ASSERT_TRUE(display_present());
  Scene scene = test::small_scene();
  scene.render.size_px = {960, 540};
  scene.render.show_panels = true;
  ViewModel model(scene);
  render::Window window(scene, model);
  PanelFacts facts;
  facts.interactive = true;
  window.draw(facts);
  for (const auto& chunk : test::chunks_of(test::cube_surface(12, 0.1, 0xff96b4e6U), 0, 1)) model.take(chunk);
  Image image;
  window.draw(facts, &image);
  ASSERT_EQ(image.width, 960);
  ASSERT_EQ(image.height, 540);
  const int middle = (960 + static_cast<int>(panel_width * 0.75F)) / 2;
  EXPECT_GT(image.at(middle, 270)[0], image.at(middle, 270)[2] + 15);  // skin
  EXPECT_LT(image.at(950, 10)[0], image.at(950, 10)[2] + 8);           // background
  int dark = 0;
  for (int y = 0; y < 540; ++y) {
    for (int x = 0; x < 220; ++x) dark += image.at(x, y)[0] < 90 ? 1 : 0;
  }
  EXPECT_GT(dark, 150);  // letters
  EXPECT_FALSE(window.closing());
}

TEST(Window, LeadsAToolWithMouseWheelAndKeys) {
  Scene scene = test::small_scene();
  scene.title = "Led by mouse";
  scene.render.size_px = {960, 540};
  scene.render.show_panels = true;
  ViewModel model(scene);
  render::Window window(scene, model, {0});
  PanelFacts facts;
  facts.interactive = true;
  window.draw(facts);
  EXPECT_TRUE(window.pointers().empty()) << "there is nothing to point at";
  for (const auto& chunk : test::chunks_of(test::cube_surface(12, 0.1, 0xff96b4e6U), 0, 1)) model.take(chunk);
  window.draw(facts);
  ASSERT_EQ(window.pointers().size(), 1u);
  ToolPointer& pointer = window.pointers().front();
  const Vec3 lay = pointer.position();
  EXPECT_LT(lay.y(), -0.05) << "before the cube, seen along +y";

  test::WindowHand hand("Led by mouse");
  ASSERT_TRUE(hand.found());
  const auto draw = [&](int pictures) {
    for (int i = 0; i < pictures; ++i) window.draw(facts);
  };
  const auto stroke = [&](KeySym key) {
    hand.key(key, true);
    draw(2);
    hand.key(key, false);
    draw(2);
  };
  // 1. the mouse alone moves nothing
  hand.move(600, 270);
  draw(3);
  EXPECT_EQ(pointer.position(), lay);
  // 2. taken, the tool follows to the right and up, at its depth
  stroke(XK_t);
  ASSERT_TRUE(pointer.held());
  const Vec3 before = pointer.position();
  hand.move(700, 170);
  draw(3);
  EXPECT_GT(pointer.position().x(), before.x() + 0.005);
  EXPECT_GT(pointer.position().z(), before.z() + 0.005);
  EXPECT_NEAR(pointer.position().y(), lay.y(), 1e-12);
  // 3. two notches deeper
  hand.wheel(true);
  draw(2);
  hand.wheel(true);
  draw(2);
  EXPECT_GT(pointer.position().y(), lay.y() + 1e-4);
  // 4. the panels are not the picture
  const Vec3 there = pointer.position();
  hand.move(40, 170);
  draw(3);
  EXPECT_EQ(pointer.position(), there);
  // 5. turned by a key, its button by another
  hand.move(700, 170);
  hand.key(XK_Right, true);
  hand.key(XK_space, true);
  draw(5);
  EXPECT_EQ(pointer.message(1).buttons, 1u);
  EXPECT_GT((pointer.attitude() * Vec3::UnitX()).y(), 1e-4);
  hand.key(XK_Right, false);
  hand.key(XK_space, false);
  draw(2);
  // 6. and let go
  stroke(XK_t);
  EXPECT_FALSE(pointer.held());
  EXPECT_EQ(pointer.message(2).held, 0u);
}

TEST(Window, SaysWhyItCannotOpen) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto open_nowhere = [] {
    setenv("DISPLAY", ":98765", 1);
    const Scene scene = test::small_scene();
    ViewModel model(scene);
    try {
      const render::Window window(scene, model);
    } catch (const InputError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      std::exit(exit_mistake);
    }
    std::exit(exit_ok);
  };
  EXPECT_EXIT(open_nowhere(), testing::ExitedWithCode(exit_mistake), "cannot open a window.*--headless");
}

}  // namespace
}  // namespace palpate::render
