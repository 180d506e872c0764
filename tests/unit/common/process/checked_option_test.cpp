// A number of the command line is in its range, or is answered with one line.
#include "common/process/checked_option.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpate {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The complaint about `--seconds TEXT`; empty: taken.
std::string said_of(const std::string& text, const Range& range = run_seconds) {
  double seconds = 0;
  CLI::App app;
  app.add_option("--seconds", seconds)->check(number_in(range));
  try {
    app.parse(std::vector<std::string>{"--seconds=" + text});
    return "";
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
}

TEST(CheckedOption, TakesNumbersOfTheRange) {
  for (const char* text : {"1", "0.5", "1e-3", "1000000", "1e6", ".25", "5e-324"})
    EXPECT_EQ(said_of(text), "") << text;
  EXPECT_EQ(said_of("0", {.lo = 0, .hi = 1}), "");
  EXPECT_EQ(said_of("-0", {.lo = 0, .hi = 1}), "");
}

TEST(CheckedOption, RefusesWhatLiesOutsideAndWhatIsNoNumber) {
  for (const char* text : {"nan", "-nan", "NaN", "inf", "-inf", "infinity", "0", "-0", "-1", "1e7", "1e300",
                           "1e999", "1e-999"}) {
    EXPECT_THAT(said_of(text), StartsWith("--seconds: ")) << text;
    EXPECT_THAT(said_of(text), HasSubstr("is out of range; write a number above 0 and at most 1000000"))
        << text;
  }
  for (const char* text : {"soon", "1s", "0x10", "1,5", "--", "1 2", " 1"}) {
    EXPECT_THAT(said_of(text), StartsWith("--seconds: ")) << text;
    EXPECT_THAT(said_of(text), HasSubstr("is no number; write a number above 0")) << text;
  }
  EXPECT_THAT(said_of("nan", {.lo = 0}), HasSubstr("write a number, 0 or more"));
  EXPECT_THAT(said_of("inf", {.lo = 0}), HasSubstr("write a number, 0 or more"));
}

}  // namespace
}  // namespace palpate
