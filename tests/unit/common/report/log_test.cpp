#include "common/report/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpate {
namespace {

TEST(Log, WritesOneLineWithTimeNameLevelAndText) {
  testing::internal::CaptureStderr();
  set_log_name("physics");
  log_warn("step {:.2f} ms over {:.2f} ms {{}}", 0.62, 0.5);
  log_error("stop");
  log_info("100 % {braces} stay", fmt::arg("braces", "{x}"));
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_THAT(lines, testing::MatchesRegex(
                         " *[0-9]+\\.[0-9][0-9][0-9] physics warn  step 0.62 ms over 0.50 ms \\{\\}\n"
                         " *[0-9]+\\.[0-9][0-9][0-9] physics error stop\n"
                         " *[0-9]+\\.[0-9][0-9][0-9] physics info  100 % \\{x\\} stay\n"));
}

}  // namespace
}  // namespace palpate
