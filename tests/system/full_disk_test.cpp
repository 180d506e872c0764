// A session whose results fill their disk: the hand and the tissue go on, and it is told. A disk of its own needs a mount
// namespace; skipped, with words, where the kernel makes none for the one who runs the tests.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/dds_domain.h"
#include "tests/system/shell.h"

namespace palpate::test {
namespace {

using testing::HasSubstr;

class FullDisk : public CommandRun {
 protected:
  void SetUp() override {
    CommandRun::SetUp();
    as_user = geteuid() == 0 ? "" : "--user --map-root-user ";
    const std::string attempt = fmt::format("unshare {}--mount mount -t tmpfs none {} 2>{}", as_user,
                                            test::quoted(folder), test::quoted(folder / "why"));
    if (std::system(attempt.c_str()) != 0) GTEST_SKIP() << "no disks of our own here";
  }

  /// `palpate run` on a disk of so many kB; what it left is then in folder/kept. @return exit code
  int run_on(int kB) {
    std::filesystem::create_directories(folder / "disk");
    std::filesystem::create_directories(folder / "kept");
    const std::string run =
        fmt::format("{} run {} --headless --seconds 6 --domain {} --out disk/out", test::quoted(PALPATE),
                    test::quoted(SCENES "/box_press.toml"), own_domain());
    const std::string line = fmt::format(
        "cd {} && unshare {}--mount sh -c {} >log 2>&1", test::quoted(folder), as_user,
        test::quoted(fmt::format(
            "mount -t tmpfs -o size={}k none disk && {}; code=$?; df disk; rm -f disk/out/record.h5; "
            "cp -r disk/out kept; exit $code",
            kB, run)));
    const int status = std::system(line.c_str());
    std::ifstream in(folder / "log");
    log.assign(std::istreambuf_iterator<char>(in), {});
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string as_user;
};

TEST_F(FullDisk, HandAndTissueGoOnAndItIsTold) {
  EXPECT_EQ(run_on(1400), 1) << log;
  EXPECT_THAT(log, HasSubstr("the record can no longer be written; the session goes on without it")) << log;
  const auto summary = read_json((folder / "kept" / "out" / "summary.json").string());
  EXPECT_GT(summary["wall_s"].get<double>(), 5.9) << "to the end";
  EXPECT_GT(summary["haptic"]["ticks"].get<int>(), 3'000);
  EXPECT_EQ(summary["haptic"]["faults"], 0);
  EXPECT_GT(summary["render"]["frames_lost"].get<int>(), 0);
}

TEST_F(FullDisk, WithoutRoomASessionDoesNotBegin) {
  EXPECT_EQ(run_on(500), 2) << log;
  EXPECT_THAT(log, HasSubstr("has no room for results (No space left on device)"));
  EXPECT_FALSE(std::filesystem::exists(folder / "kept" / "out" / "summary.json"));
}

}  // namespace
}  // namespace palpate::test
