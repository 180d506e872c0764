#include "deploy/palpate/out_folder.h"

#include <gtest/gtest.h>

#include "common/error/error.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {
namespace fs = std::filesystem;

TEST(OutFolder, IsNamedAfterTheScene) {
  EXPECT_EQ(default_out("scenes/head_120x120x70.toml"), fs::path("out/head_120x120x70"));
}

TEST(OutFolder, IsMadeAndFreedOfAnEarlierSession) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "a/b";
  prepare_out(out);
  EXPECT_TRUE(fs::is_directory(out / "parts"));
  fs::create_directories(out / "frames");
  for (const char* name : {"summary.json", "force.png", "frames/0001.png", "parts/physics.json"}) {
    folder.write(std::string("a/b/") + name, "old");
  }
  folder.write("a/b/notes.txt", "mine");
  folder.write("a/b/frames/notes.txt", "mine");
  prepare_out(out);
  for (const char* name : {"summary.json", "force.png", "frames/0001.png", "parts/physics.json"}) {
    EXPECT_FALSE(fs::exists(out / name)) << name;
  }
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
  EXPECT_TRUE(fs::exists(out / "frames/notes.txt"));
}

TEST(OutFolder, CannotStandInAFile) {
  const test::TemporaryFolder folder;
  folder.write("file", "text");
  EXPECT_THROW(prepare_out(folder / "file/out"), InputError);
  EXPECT_THROW(prepare_out(folder / "file"), InputError);
}

}  // namespace
}  // namespace palpate::deploy
