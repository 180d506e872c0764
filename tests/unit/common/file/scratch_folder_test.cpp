#include "common/file/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace palpate {
namespace {

TEST(ScratchFolder, IsPrivateItsOwnAndGoneWithAllThatIsInIt) {
  std::filesystem::path first;
  {
    const ScratchFolder one, other;
    first = one.path();
    EXPECT_NE(one.path(), other.path());
    EXPECT_EQ(std::filesystem::status(first).permissions(), std::filesystem::perms::owner_all);
    std::filesystem::create_directory(first / "inside");
    std::ofstream(first / "inside" / "file") << "text";
  }
  EXPECT_FALSE(std::filesystem::exists(first));
}

TEST(ScratchFolder, SaysThatTMPDIRNamesNoFolder) {
  const ScratchFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", (folder.path() / "nowhere").c_str(), 1);
  try {
    const ScratchFolder another;
    ADD_FAILURE() << another.path();
  } catch (const InputError& error) {
    EXPECT_THAT(error.complaints(), testing::ElementsAre(testing::HasSubstr("by the variable TMPDIR")));
  }
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace palpate
