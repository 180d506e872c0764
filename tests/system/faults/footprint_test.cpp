// What a session leaves behind is told from what it may read, wherever the clone lies; what grows from what passes.

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

Footprint with_threads(int threads) {
  Footprint found;
  found.threads = threads;
  return found;
}

int growth_in_threads(std::initializer_list<int> looks) {
  Growth growth;
  for (const int threads : looks) growth.look(1, with_threads(threads));
  EXPECT_EQ(growth.largest().threads > 0, !growth.text().empty());
  return growth.largest().threads;
}

TEST(Growth, SeesWhatStaysAndNotWhatPasses) {
  EXPECT_EQ(growth_in_threads({14, 14, 14, 14, 14, 14, 14, 14}), 0);
  EXPECT_EQ(growth_in_threads({14, 14, 14, 14, 15, 15, 15, 15}), 1);
  EXPECT_EQ(growth_in_threads({14, 15, 15, 16, 16, 17, 17, 17}), 2);
  EXPECT_EQ(growth_in_threads({13, 14, 14, 14, 14, 14, 14, 14}), 0) << "it was still starting";
  EXPECT_EQ(growth_in_threads({14, 14, 14, 14, 14, 15, 14, 15}), 0) << "for a moment";
  EXPECT_EQ(growth_in_threads({15, 14, 14, 14, 14, 15, 15, 15}), 1) << "a moment at the start hides nothing";
}

TEST(Growth, NamesTheProcessAndItsThreads) {
  Growth growth;
  for (int threads = 1; threads <= 8; ++threads) growth.look(getpid(), with_threads(threads));
  EXPECT_NE(growth.text().find("footprint_test, files and threads at every look: 0/1 0/2"), std::string::npos)
      << growth.text();
  EXPECT_NE(growth.text().find("threads now: footprint_test"), std::string::npos) << growth.text();
}

}  // namespace
}  // namespace palpate::test
