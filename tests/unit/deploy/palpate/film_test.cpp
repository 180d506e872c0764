// With an ffmpeg that says what it was asked for: a script of this test.

#include "deploy/palpate/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "common/error/error.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// PATH leads to this folder and nowhere else, for the length of a test.
class Film : public testing::Test {
 protected:
  Film() : before(std::getenv("PATH")) { setenv("PATH", folder.path().c_str(), 1); }
  ~Film() override { setenv("PATH", before.c_str(), 1); }
  void install(const std::string& script) {
    folder.write("ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
  }
  std::string complaint(const fs::path& film) {
    try {
      require_film(film);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  const std::string before;
  const test::TemporaryFolder folder;
};

TEST_F(Film, SaysWhatHindersItBeforeAnythingIsStarted) {
  EXPECT_THAT(complaint(folder / "a.mp4"), HasSubstr("no ffmpeg is installed; install the package ffmpeg"));
  install("exit 0\n");
  EXPECT_EQ(complaint(folder / "a.mp4"), "");
  folder.write("a.mp4", "mine");
  EXPECT_THAT(complaint(folder / "a.mp4"), HasSubstr("lies there already"));
  EXPECT_THAT(complaint(folder / "none" / "a.mp4"), HasSubstr("no such folder"));
}

TEST_F(Film, RunsAsSimulatedTimeDoes) {
  install("for last; do :; done\necho \"$@\" > \"$last\"\n");
  const nlohmann::json thinned = {{"render", {{"frames_every", 4}}}};
  for (const auto& [summary, rate] : {std::pair{nlohmann::json::object(), "10"}, std::pair{thinned, "2.5"}}) {
    const fs::path film = folder / (std::string(rate) + ".mp4");
    testing::internal::CaptureStdout();
    EXPECT_TRUE(make_film(folder.path(), summary, 10, film));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "film     " + film.string() + "\n");
    std::ifstream file(film);
    const std::string asked(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(asked, HasSubstr(std::string(" -framerate ") + rate + " -i " +
                                 (folder / "frames" / "frame_%05d.png").string() + " "));
  }
}

TEST_F(Film, LeavesNoHalfOfOne) {
  install("for last; do :; done\necho half > \"$last\"\nexit 3\n");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(make_film(folder.path(), nlohmann::json::object(), 10, folder / "a.mp4"));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("exit code 3, so there is no film"));
  EXPECT_FALSE(fs::exists(folder / "a.mp4"));
}

}  // namespace
}  // namespace palpate::deploy
