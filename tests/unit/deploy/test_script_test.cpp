// deploy/test.sh in a folder of its own, with stand-ins for CMake and CTest: whether it comes to its sanitizers, counts what
// they ran, and fails when they do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A CTest that leaves one program with two cases; $FAULT as a preset makes it fail there, as nothing:PRESET select none.
constexpr auto ctest = R"(#!/bin/bash
preset=$2 label=${*: -1}
echo "ctest $preset $label" >>"$CALLS"
results=build/$preset/test_results
case $FAULT in
  "$preset") status=fail code=8 ;;
  *) status=run code=0 ;;
esac
[ "$FAULT" = "nothing:$preset" ] && echo '<testsuite/>' >"$results/ctest.xml" && exit 0
echo "<testsuite><testcase name='a' status='$status'/></testsuite>" >"$results/ctest.xml"
echo "<testsuites><testsuite><testcase name='One' status='run' classname='S'/><testcase name='Two' status='run' classname='S'/></testsuite></testsuites>" >"$results/a.xml"
exit $code
)";

class TestScript : public testing::Test {
 public:
  TestScript() {
    fs::create_directories(folder_ / "deploy");
    fs::create_directories(folder_ / "bin");
    for (const auto* name : {"test.sh", "step.sh", "count_tests.py"})
      fs::copy(fs::path(DEPLOY) / name, folder_ / "deploy");
    for (const auto* name :
         {"deploy/install_packages.sh", "deploy/fetch_head.sh", "deploy/fetch_liver.sh", "bin/cmake"})
      program(name,
              "#!/bin/bash\necho \"$(basename \"$0\") $*\" >>\"$CALLS\"\n[ -z \"$FAULT\" ] || [ \"$FAULT\" "
              "!= \"$*\" ]\n");
    program("bin/ctest", ctest);
    program("bin/sleep", "#!/bin/bash\nexec /bin/sleep 0.01\n");  // between two looks at a step
  }

 protected:
  /// What it says at the end, and its exit code.
  std::pair<std::string, int> run(const std::string& fault, const std::string& option = "") const {
    const auto in = "'" + folder_.path().string() + "'";
    const int status =
        std::system(("cd " + in + " && FAULT='" + fault + "' CALLS=" + in + "/calls PATH=" + in +
                     "/bin:\"$PATH\" deploy/test.sh " + option + " >said 2>&1")
                        .c_str());
    return {text("said"), WEXITSTATUS(status)};
  }
  std::string text(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  void program(const std::string& name, const std::string& script) const {
    folder_.write(name, script);
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  test::TemporaryFolder folder_;
};

TEST_F(TestScript, RunsAllButTheThoroughAndTheDoorsWithASanitizer) {
  const auto [said, code] = run("");
  EXPECT_THAT(said, EndsWith("\n4 passed, 0 failed, 0 skipped\n"));
  EXPECT_EQ(code, 0);
  const std::string calls = text("calls");
  EXPECT_THAT(calls, HasSubstr("ctest ready ^thorough$\n"));
  EXPECT_THAT(calls, HasSubstr("--target doors_tests\nctest asan ^doors$\n"));
  EXPECT_THAT(calls, Not(HasSubstr("tsan")));
}

TEST_F(TestScript, RunsEveryCaseAndBothSanitizersWhenAsked) {
  const auto [said, code] = run("", "--all");
  EXPECT_THAT(said, EndsWith("\n6 passed, 0 failed, 0 skipped\n"));
  EXPECT_EQ(code, 0);
  const std::string calls = text("calls");
  EXPECT_THAT(calls, HasSubstr("ctest ready -j2\n"));
  EXPECT_THAT(calls, HasSubstr("--target address_tests\nctest asan ^address$\n"));
  EXPECT_THAT(calls, HasSubstr("--target thread_tests\nctest tsan ^thread$\n"));
}

TEST_F(TestScript, FailsWhereATestFailsWithASanitizer) {
  for (const auto* preset : {"asan", "tsan"}) {
    const auto [said, code] = run(preset, "--all");
    EXPECT_THAT(said, HasSubstr("failed: a: all its cases passed, but not the program")) << preset;
    EXPECT_THAT(said, EndsWith("\n6 passed, 1 failed, 0 skipped\n")) << preset;
    EXPECT_EQ(code, 1) << preset;
  }
  EXPECT_EQ(run("asan").second, 1);
}

TEST_F(TestScript, FailsWhereASanitizerRunsNothing) {
  for (const auto* fault : {"nothing:asan", "nothing:tsan"}) {
    const auto [said, code] = run(fault, "--all");
    EXPECT_THAT(said, EndsWith("\n4 passed, 1 failed, 0 skipped\n")) << fault;
    EXPECT_EQ(code, 1) << fault;
  }
  EXPECT_EQ(run("nothing:asan").second, 1);
}

TEST_F(TestScript, FailsWhereABuildWithASanitizerFails) {
  const auto [said, code] = run("--preset tsan", "--all");
  EXPECT_THAT(said, EndsWith("\n4 passed, 1 failed, 0 skipped\n"));
  EXPECT_EQ(code, 1);
}

TEST_F(TestScript, ShowsAllUnitAndPropertyTestsToTheAddressSanitizerWhenAsked) {
  const auto [said, code] = run("", "--sanitizers");
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text("calls"), HasSubstr("ctest ready -j2\n"));
  EXPECT_THAT(text("calls"), HasSubstr("--target all\nctest asan ^(unit|property|sanitizers)$\n"));
  EXPECT_THAT(text("calls"), HasSubstr("ctest tsan ^thread$\n"));
}

}  // namespace
}  // namespace palpate::deploy
