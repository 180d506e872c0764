// Runs under a virtual display (CMakeLists.txt).
#include "render_node/ui/window.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/error/error.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

TEST(Window, ShowsTheBodyAndThePanels) {
  ASSERT_TRUE(display_present());
  Scene scene = test::small_scene();
  scene.render.size_px = {960, 540};
  scene.render.show_panels = true;
  ViewModel model(scene);
  Window window(scene, model);
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

TEST(Window, SaysWhyItCannotOpen) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto open_nowhere = [] {
    setenv("DISPLAY", ":98765", 1);
    const Scene scene = test::small_scene();
    ViewModel model(scene);
    try {
      const Window window(scene, model);
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
