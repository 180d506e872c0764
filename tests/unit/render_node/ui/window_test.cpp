// Runs under a virtual display (CMakeLists.txt).
#include "render_node/ui/window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error/error.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/image/png_file.h"
#include "tests/unit/render_node/render_support.h"
// Last: Xlib's macros.
#include "tests/unit/render_node/ui/shown_window.h"

namespace palpate::render {
namespace {

using test::ink;
using test::Shown;

TEST(Window, ShowsTheBodyAndThePanels) {
  ASSERT_TRUE(display_present());
  Scene scene = test::small_scene();
  scene.render->size_px = {960, 540};
  scene.render->show_panels = true;
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
  scene.tools[0].radius = 1e-9;  // it is not lifted before it is put down
  scene.render->size_px = {960, 540};
  scene.render->show_panels = true;
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
  // 1. the mouse alone moves nothing; the tool lies before the surface in the middle
  EXPECT_NEAR(lay.y(), -0.05 - 0.5 * 0.1 / 12, 2e-4);
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
  EXPECT_NEAR(pointer.position().y(), lay.y(), 1e-6);
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

/// At three pictures a second every tap is shorter than a picture: key down and up come between two.
TEST(Window, LosesNoTapHoweverSeldomItDraws) {
  Shown shown("Taps", 640, 480, true);
  ASSERT_TRUE(shown.hand->found());
  ToolPointer& pointer = shown.window->pointers().front();
  for (int i = 1; i <= 6; ++i) {
    shown.tap(XK_t);
    shown.draw();
    EXPECT_EQ(pointer.held(), i % 2 == 1) << "tap " << i;
    shown.draw();
    EXPECT_EQ(pointer.held(), i % 2 == 1) << "a tap counts once";
  }
  shown.tap(XK_t);
  shown.draw();
  shown.tap(XK_space);
  shown.draw();
  EXPECT_EQ(pointer.message(1).buttons, 1u) << "seen by the hand in one sample";
  shown.draw();
  EXPECT_EQ(pointer.message(2).buttons, 0u);
  const auto before = pointer.attitude();
  shown.tap(XK_Right);
  shown.draw();
  EXPECT_GT(pointer.attitude().angularDistance(before), 1e-3);
  EXPECT_FALSE(shown.window->closing());
  shown.tap(XK_Escape);
  shown.draw();
  EXPECT_TRUE(shown.window->closing());
}

TEST(Window, StartsAToolOnTheSurfaceUnderTheCursor) {
  Shown shown("On the surface", 640, 480, true);
  ASSERT_TRUE(shown.hand->found());
  ToolPointer& pointer = shown.window->pointers().front();
  for (const auto& [x, y] : {std::pair{400, 240}, std::pair{470, 200}}) {
    shown.hand->move(x, y);
    shown.draw();
    shown.tap(XK_t);
    shown.draw();
    ASSERT_TRUE(pointer.held());
    EXPECT_NEAR(pointer.position().y(), -0.05 - 0.5 * 0.1 / 12, 3e-4) << "half an edge before the near side";
    EXPECT_LT(std::abs(pointer.position().x()), 0.05);
    shown.hand->wheel(true);
    shown.draw();
    shown.draw();
    shown.tap(XK_t);
    shown.draw();
    ASSERT_FALSE(pointer.held());
  }
}

void say(ViewModel& model, NodeKind node, const std::string& note) {
  NodeStatus status;
  status.node = node;
  status.phase = NodePhase::running;
  std::copy(note.begin(), note.end(), status.note.begin());
  model.take(status);
}

TEST(Window, SaysInTheMiddleWhyThereIsNoForce) {
  for (const auto& [width, height] : {std::pair{640, 480}, std::pair{1280, 720}}) {
    Shown shown("Why " + std::to_string(height), width, height, false);
    const int panel = static_cast<int>(0.4 * width);
    Image image;
    const auto ink_in_the_middle = [&] {
      shown.draw();
      shown.draw(&image);
      return ink(image, panel + 10, width - 10, height / 2 - 20, height / 2 + 20);
    };
    say(*shown.model, NodeKind::haptic, "no rights; finger: run");
    const int none = ink_in_the_middle();
    say(*shown.model, NodeKind::haptic, "no rights; finger: ready (inside the tissue, move out)");
    EXPECT_GT(ink_in_the_middle(), none + 200) << width;
    say(*shown.model, NodeKind::haptic, "no rights; finger: run");
    EXPECT_NEAR(ink_in_the_middle(), none, 20);
  }
}

/// Everything is laid out within the window, or can be scrolled to: the last row is seen at the end of the wheel's way.
TEST(Window, PanelFitsAnyWindowOrScrolls) {
  for (const auto& [width, height] :
       {std::pair{640, 480}, std::pair{1280, 720}, std::pair{480, 240}, std::pair{1024, 768}}) {
    Shown shown("Fits " + std::to_string(height), width, height, true);
    ASSERT_TRUE(shown.hand->found());
    for (std::uint64_t n = 1; n < 400; ++n) {
      auto trace = test::trace_at({0, -0.05, 0}, 0.01 * static_cast<double>(n), 1);
      trace.samples[0].tick = n;
      shown.model->take(trace);
      ToolWrench wrench;
      wrench.answers = n;
      wrench.force = {0, 0, 1};
      wrench.moment = {0.01, 0.02, 0};
      shown.model->take(wrench);
    }
    say(*shown.model, NodeKind::haptic,
        "no real-time rights, ticks may come late; finger: ready (nobody holds it)");
    say(*shown.model, NodeKind::physics, "the time step is above the stable one; expect the guard to act");
    say(*shown.model, NodeKind::render, "");
    shown.hand->move(60, height / 2);
    Image image;
    for (int i = 0; i < 15; ++i) {
      shown.hand->wheel(false);
      shown.draw();
    }
    shown.draw(&image);
    if (const char* folder = std::getenv("PALPATE_TEST_PICTURES"))
      write_png(image, std::string(folder) + "/end_" + std::to_string(height) + ".png");
    // The last row is "arrow: 1 N is": its ink ends above the lower edge, and nothing is laid out below it.
    const int line = static_cast<int>(25.0 * height / 720) + 8;
    EXPECT_GT(ink(image, 4, static_cast<int>(0.3 * width), height - 3 * line, height), 8) << height;
    EXPECT_EQ(ink(image, 4, static_cast<int>(0.2 * width), height - 3, height), 0)
        << height << ": a row is cut";
    // Back to the top.
    for (int i = 0; i < 15; ++i) {
      shown.hand->wheel(true);
      shown.draw();
    }
    shown.draw(&image);
    const int panel = static_cast<int>(0.2 * width);
    const auto changes = [&](const auto& change) {
      Image before = image, after;
      change();
      shown.draw();
      shown.draw(&after);
      int n = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < panel; ++x)
          n += std::equal(before.at(x, y), before.at(x, y) + 3, after.at(x, y)) ? 0 : 1;
      return n;
    };
    EXPECT_GT(changes([&] { say(*shown.model, NodeKind::physics, "frames take longer than they may"); }), 50)
        << height << ": what physics warns of is out of sight";
    EXPECT_GT(changes([&] { shown.tap(XK_t); }), 50) << height << ": the keys are out of sight";
    if (const char* folder = std::getenv("PALPATE_TEST_PICTURES"))
      write_png(image, std::string(folder) + "/panel_" + std::to_string(height) + ".png");
  }
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
