// The count of deploy/test.sh: by case, with the names of all that did not pass. No case may be skipped silently.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "cannot run " + command;
  std::array<char, 512> part{};
  while (fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr) text += part.data();
  pclose(pipe);
  return text;
}

/// What CTest and the programs left: each program with its status, each with its cases.
class Results {
 public:
  void program(const std::string& name, const std::string& status) {
    programs_ += "<testcase name=\"" + name + "\" classname=\"" + name + "\" status=\"" + status + "\"/>\n";
  }
  void cases(const std::string& program, const std::string& all) const {
    folder_.write(program + ".xml",
                  "<testsuites name=\"AllTests\"><testsuite name=\"S\">" + all + "</testsuite></testsuites>");
  }
  std::string counted() const {
    folder_.write("ctest.xml", "<testsuite name=\"(empty)\">" + programs_ + "</testsuite>");
    return counted_from(folder_ / "ctest.xml");
  }
  std::string counted_from(const std::filesystem::path& junit) const {
    return output_of("python3 '" COUNT_TESTS "' '" + junit.string() + "' '" + folder_.path().string() + "'");
  }
  const test::TemporaryFolder& folder() const { return folder_; }

 private:
  test::TemporaryFolder folder_;
  std::string programs_;
};

std::string passing(const std::string& name) {
  return "<testcase name=\"" + name + "\" status=\"run\" result=\"completed\" classname=\"S\"/>";
}

TEST(CountTests, CountsCasesAndNamesThoseThatFailed) {
  Results results;
  results.program("a", "run");
  results.cases("a", passing("One") + passing("Two"));
  results.program("b", "fail");
  results.cases("b", passing("Three") +
                         "<testcase name=\"Four\" status=\"run\" classname=\"S\"><failure message=\"1 is not "
                         "2\"/></testcase>");
  EXPECT_EQ(results.counted(), "failed: b: S.Four\n3 passed, 1 failed, 0 skipped\n");
}

TEST(CountTests, NamesDisabledCasesAndProgramsThatAreLeftOut) {
  Results results;
  results.program("a", "run");
  results.cases(
      "a", passing("One") +
               "<testcase name=\"DISABLED_Two\" status=\"notrun\" result=\"suppressed\" classname=\"S\"/>");
  results.program("b", "disabled");
  EXPECT_EQ(results.counted(),
            "skipped: a: S.DISABLED_Two: disabled\nskipped: b: left out of this build\n"
            "1 passed, 0 failed, 2 skipped\n");
}

TEST(CountTests, CountsProgramsThatDieOrRunNothingAsFailed) {
  Results results;
  results.program("killed", "fail");
  results.program("missing", "notrun");
  results.program("silent", "run");
  results.program("empty", "run");
  results.cases("empty", "");
  results.program("leaking", "fail");
  results.cases("leaking", passing("One"));
  results.program("broken", "run");
  results.folder().write("broken.xml", "<testsuites><testsuite>");
  const std::string counted = results.counted();
  for (const auto* name : {"killed", "missing", "silent", "empty", "leaking", "broken"})
    EXPECT_THAT(counted, HasSubstr(std::string("failed: ") + name + ": "));
  EXPECT_THAT(counted, EndsWith("\n1 passed, 6 failed, 0 skipped\n"));
}

TEST(CountTests, FailsWithoutResultsOfCTest) {
  const Results results;
  EXPECT_THAT(results.counted_from(results.folder() / "nowhere.xml"),
              EndsWith("\n0 passed, 1 failed, 0 skipped\n"));
}

/// A label that no test bears must not pass for tests that passed.
TEST(CountTests, FailsWhereNoTestWasSelected) {
  const Results results;
  EXPECT_EQ(results.counted(), "failed: ctest: no test was selected\n0 passed, 1 failed, 0 skipped\n");
}

/// A case that skips when the test below asks it to; CTest sees it pass.
TEST(SampleOfASkippedCase, SkipsWhenAsked) {
  if (std::getenv("PALPATE_SKIP_A_SAMPLE") != nullptr) GTEST_SKIP() << "no device here";
}

/// The same with results that GoogleTest has really written.
TEST(CountTests, NamesSkippedCasesAndTheirReasons) {
  Results results;
  results.program("sample", "run");
  const auto xml = results.folder() / "sample.xml";
  const auto run = "'" + std::filesystem::read_symlink("/proc/self/exe").string() +
                   "' --gtest_filter='SampleOfASkippedCase.*' --gtest_output='xml:" + xml.string() + "'";
  output_of("PALPATE_SKIP_A_SAMPLE=1 " + run);
  EXPECT_THAT(results.counted(),
              testing::MatchesRegex("skipped: sample: SampleOfASkippedCase.SkipsWhenAsked: "
                                    ".*no device here\n0 passed, 0 failed, 1 skipped\n"));
  output_of(run);
  EXPECT_EQ(results.counted(), "1 passed, 0 failed, 0 skipped\n");
}

}  // namespace
}  // namespace palpate::deploy
