#include "render_node/image/screenshot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/error/error.h"

namespace palpate::render {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path path = fs::path(testing::TempDir()) / ("palpate_screenshot_" + std::to_string(getpid()));
};

Image grey() { return {4, 2, std::vector<std::uint8_t>(24, 127)}; }

TEST(Screenshot, NeverWritesOverWhatLiesThere) {
  const Folder folder;
  std::ofstream(folder.path / "picture_0001.png") << "mine";
  fs::create_symlink(folder.path / "nowhere", folder.path / "picture_0002.png");
  EXPECT_EQ(save_screenshot(grey(), folder.path.string()), (folder.path / "picture_0003.png").string());
  EXPECT_EQ(save_screenshot(grey(), folder.path.string()), (folder.path / "picture_0004.png").string());
  std::ifstream mine(folder.path / "picture_0001.png");
  std::string text;
  mine >> text;
  EXPECT_EQ(text, "mine");
  EXPECT_FALSE(fs::exists(folder.path / "nowhere")) << "nor where a link leads";
}

TEST(Screenshot, SaysWhereItCannotBe) {
  const Folder folder;
  EXPECT_THROW(save_screenshot(grey(), (folder.path / "none").string()), InputError);
}

}  // namespace
}  // namespace palpate::render
