// What a session leaves behind is told from what it may read, wherever the clone lies.

#include "tests/system/faults/footprint.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <fstream>

namespace palpate::test {
namespace {

namespace fs = std::filesystem;

class Leftovers : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = "/tmp/palpate_footprint_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
    fs::create_directories(folder / "clone" / "build");
    for (const char* file : {"clone/scene.toml", "clone/build/palpate-physics", "clone_2", "segment"})
      std::ofstream(folder / file) << file;
  }
  void TearDown() override { fs::remove_all(folder); }

  std::set<std::string> of(const std::set<std::string>& shared) const {
    std::set<std::string> left;
    for (const auto& path : shared)
      if (!lies_in({folder / "clone"}, path)) left.insert(path);
    return left;
  }
  fs::path folder;
};

TEST_F(Leftovers, AreNotWhatLiesInTheClone) {
  const std::string scene = folder / "clone/scene.toml", program = folder / "clone/build/palpate-physics",
                    beside = folder / "clone_2", segment = folder / "segment";
  EXPECT_EQ(of({scene, program, beside, segment}), (std::set<std::string>{beside, segment}));
  EXPECT_EQ(of({(folder / "clone/../segment").string()}).size(), 1U);
  fs::create_symlink(folder / "clone", folder / "other_way");
  EXPECT_EQ(of({(folder / "other_way/scene.toml").string()}).size(), 0U) << "by whatever name";
  const auto lines = left_behind({segment}, {}, 100);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.front(), segment + " was opened and is left behind");
}

TEST_F(Leftovers, AreSeenInTheFootprintOfAProcess) {
  std::ifstream open(folder / "segment");
  EXPECT_TRUE(footprint(getpid()).shared.contains((folder / "segment").string()));
  open.close();
  EXPECT_FALSE(footprint(getpid()).shared.contains((folder / "segment").string()));
}

}  // namespace
}  // namespace palpate::test
