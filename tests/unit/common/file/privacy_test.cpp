#include "common/file/privacy.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using test::ScratchFolder;

TEST(Privacy, WithholdsWhatTheNarrowestInputWithholds) {
  const ScratchFolder folder;
  const auto with_mode = [&](const std::string& name, mode_t mode) {
    const std::string path = folder / name;
    std::ofstream(path) << "image";
    EXPECT_EQ(chmod(path.c_str(), mode), 0);
    return path;
  };
  const std::string open = with_mode("a", 0644), group = with_mode("b", 0640), own = with_mode("c", 0600),
                    shared = with_mode("d", 0664), once = with_mode("e", 0400), all = with_mode("f", 0666);
  EXPECT_EQ(withheld({}), 0u);
  EXPECT_EQ(withheld({folder / "none"}), 0u);
  EXPECT_EQ(withheld({all}), 0u);
  EXPECT_EQ(withheld({open}), 0022u);
  EXPECT_EQ(withheld({shared}), 0002u);
  EXPECT_EQ(withheld({group}), 0027u);
  EXPECT_EQ(withheld({own}), 0077u);
  EXPECT_EQ(withheld({once}), 0077u);
  EXPECT_EQ(withheld({all, own, open}), 0077u);
  EXPECT_EQ(withheld({all, group}), 0027u);
}

TEST(Privacy, CountsAGroupThatIsNotOursOnlyWhereAllMayRead) {
  const ScratchFolder folder;
  const std::string path = folder / "a";
  std::ofstream(path) << "image";
  if (chown(path.c_str(), static_cast<uid_t>(-1), getegid() + 1) != 0)
    GTEST_SKIP() << "not allowed to give files away";
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  EXPECT_EQ(withheld({path}), 0077u);
  ASSERT_EQ(chmod(path.c_str(), 0644), 0);
  EXPECT_EQ(withheld({path}), 0022u);
}

TEST(Privacy, CountsTheFoldersAboveWhoeverOpenTheFileIs) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "above/below");
  const std::string path = folder / "above/below/a", link = folder / "link";
  std::ofstream(path) << "image";
  std::filesystem::create_symlink(path, link);
  ASSERT_EQ(chmod(path.c_str(), 0644), 0);
  const auto with = [&](mode_t above) {
    EXPECT_EQ(chmod((folder / "above").c_str(), above), 0);
    return withheld({path});
  };
  EXPECT_EQ(with(0755), 0022u);
  EXPECT_EQ(with(0711), 0022u) << "who knows the name may read it";
  EXPECT_EQ(with(0750), 0027u);
  EXPECT_EQ(with(0705), 0072u);
  EXPECT_EQ(with(0700), 0077u);
  EXPECT_EQ(withheld({link}), 0077u) << "what a link in an open folder names";
  EXPECT_EQ(with(0744), 0077u) << "a list of names is no way through";
}

TEST(Privacy, OnlyEverTakesRightsAway) {
  const ScratchFolder folder;
  const std::string path = folder / "a";
  std::ofstream(path) << "image";
  const mode_t before = umask(0027);
  ASSERT_EQ(chmod(path.c_str(), 0644), 0);
  keep_as_private_as({path});
  EXPECT_EQ(umask(0027), 0027u);
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  keep_as_private_as({path});
  EXPECT_EQ(umask(before), 0077u);
}

}  // namespace
}  // namespace palpate
