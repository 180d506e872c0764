// Keys, clicks and the column, by a hand. Runs under a virtual display (CMakeLists.txt).
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>

#include "render_node/image/png_file.h"
#include "render_node/ui/panels.h"
// Last: Xlib's macros.
#include "tests/unit/render_node/ui/shown_window.h"

namespace palpate::render {
namespace {

using test::differing;
using test::ink;
using test::Shown;

/// Click, and the tool is there; the wheel presses from the surface on; a right click lets go. At any rate of pictures.
TEST(Window, PutsAToolWhereOneClicks) {
  Shown shown("Click", 640, 480, true);
  ASSERT_TRUE(shown.hand->found());
  ToolPointer& pointer = shown.window->pointers().front();
  const double surface = -0.05 - 0.5 * 0.1 / 12;
  shown.hand->move(470, 200);
  shown.draw();
  shown.hand->click(1);
  shown.draw();
  ASSERT_TRUE(pointer.held());
  EXPECT_NEAR(pointer.position().y(), surface, 1e-6);
  shown.draw();
  EXPECT_TRUE(pointer.held()) << "a click counts once";
  for (int i = 0; i < 3; ++i) shown.hand->wheel(true);
  shown.draw();
  shown.draw();
  const double pressed = pointer.position().y();
  EXPECT_GT(pressed, surface + 1e-3);
  shown.hand->move(400, 260);
  shown.draw();
  shown.draw();
  EXPECT_NEAR(pointer.position().y(), pressed, 1e-6) << "led along a face it stays as deep";
  // A drag turns the view and moves no tool.
  const Vec3 there = pointer.position();
  shown.hand->button(1, true);
  shown.draw();
  shown.hand->move(430, 270);
  shown.draw();
  EXPECT_EQ(pointer.position(), there);
  shown.hand->button(1, false);
  shown.hand->click(3);
  shown.draw();
  EXPECT_FALSE(pointer.held());
  shown.hand->move(630, 10);  // beside the cube
  shown.draw();
  shown.hand->click(1);
  shown.draw();
  EXPECT_FALSE(pointer.held());
}

TEST(Window, ActsByItsKeysAndTellsTheRest) {
  Shown shown("Keys", 640, 480, false);
  ASSERT_TRUE(shown.hand->found());
  EXPECT_FALSE(shown.draw().paused);
  shown.tap(XK_p);
  EXPECT_TRUE(shown.draw().paused);
  shown.facts.paused = true;
  EXPECT_TRUE(shown.draw().paused) << "as it is";
  shown.tap(XK_p);
  shown.tap(XK_p);
  EXPECT_TRUE(shown.draw().paused) << "to and fro";
  shown.tap(XK_p);
  EXPECT_FALSE(shown.draw().paused);
  shown.tap(XK_period);
  shown.tap(XK_period);
  EXPECT_EQ(shown.draw().frames_on, 2);
  EXPECT_EQ(shown.draw().frames_on, 0);
  shown.tap(XK_BackSpace);
  EXPECT_TRUE(shown.draw().reset);
  EXPECT_FALSE(shown.draw().reset);
  EXPECT_FALSE(shown.draw().picture);
  shown.tap(XK_F12);
  const auto wishes = shown.draw();
  ASSERT_TRUE(wishes.picture);
  EXPECT_EQ(wishes.picture->width, 640);
  EXPECT_EQ(wishes.picture->rgb.size(), 640u * 480u * 3u);
}

TEST(Window, ShowsHelpByF1AndQuestionMarkAndFoldsItsColumn) {
  for (const auto& [width, height] : {std::pair{1024, 768}, std::pair{1280, 720}, std::pair{640, 480}}) {
    Shown shown("Help " + std::to_string(width), width, height, true);
    ASSERT_TRUE(shown.hand->found());
    shown.hand->move(width - 20, 20);
    Image plain, image;
    const auto see = [&](Image& seen) {
      shown.draw();
      shown.draw();
      shown.draw(&seen);
    };
    see(plain);
    shown.tap(XK_F1);
    see(image);
    EXPECT_GT(differing(plain, image), width * height / 4) << "over the picture";
    EXPECT_EQ(ink(image, width - 10, width, 0, height), ink(plain, width - 10, width, 0, height))
        << "within it";
    if (const char* folder = std::getenv("PALPATE_TEST_PICTURES"))
      write_png(image, std::string(folder) + "/help_" + std::to_string(width) + ".png");
    shown.hand->key(XK_question, true, true);
    shown.hand->key(XK_question, false, true);
    see(image);
    EXPECT_EQ(differing(plain, image), 0) << "? put it away";
    shown.tap(XK_F1);
    shown.tap(XK_Escape);
    see(image);
    EXPECT_EQ(differing(plain, image), 0) << "Esc did";
    EXPECT_FALSE(shown.window->closing());
    shown.tap(XK_F2);
    see(image);
    EXPECT_LT(ink(image, 0, width / 5, height / 4, height), 300) << "only the axes are left there";
    shown.tap(XK_F2);
    see(image);
    EXPECT_EQ(differing(plain, image), 0);
    shown.tap(XK_Escape);
    shown.draw();
    EXPECT_TRUE(shown.window->closing());
  }
}

TEST(Window, LooksFromAllSidesAndBack) {
  Shown shown("Sides", 640, 480, false);
  ASSERT_TRUE(shown.hand->found());
  Image first, image;
  const auto see = [&](KeySym key) {
    shown.tap(key);
    shown.draw();
    shown.draw();
    shown.draw(&image);
  };
  see(XK_r);
  first = image;
  see(XK_3);
  EXPECT_GT(differing(first, image), 500) << "from the top";
  see(XK_1);
  EXPECT_EQ(differing(first, image), 0) << "this scene looks from the front";
  see(XK_w);
  EXPECT_GT(differing(first, image), 500);
  see(XK_w);
  EXPECT_EQ(differing(first, image), 0);
}

/// The eye before a name takes its body out of the picture, and brings it back.
TEST(Window, HidesABodyByItsEye) {
  Shown shown("Eyes", 1024, 768, false);
  ASSERT_TRUE(shown.hand->found());
  Image first, image;
  shown.draw(&first);
  const int middle = (1024 + static_cast<int>(panel_width * 768 / 720)) / 2;
  ASSERT_GT(first.at(middle, 384)[0], first.at(middle, 384)[2] + 15) << "skin";
  bool hidden = false;
  // Wherever its row may be, before its name; from below, where the opacity of tissue is not met first.
  for (int y = 700; y > 40 && !hidden; y -= 6) {
    shown.hand->move(24, y);
    shown.draw();
    shown.hand->click(1);
    for (int i = 0; i < 3; ++i) shown.draw(&image);  // down, up, gone
    hidden = image.at(middle, 384)[0] < image.at(middle, 384)[2] + 8;
  }
  ASSERT_TRUE(hidden);
  shown.hand->click(1);
  for (int i = 0; i < 3; ++i) shown.draw(&image);
  EXPECT_GT(image.at(middle, 384)[0], image.at(middle, 384)[2] + 15) << "back again";
}

}  // namespace
}  // namespace palpate::render
