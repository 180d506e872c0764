#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

using testing::HasSubstr;

TEST(WireOptions, AskForTheCostOfASampleWhereSharesOfACoreAreTold) {
  CLI::App app;
  int exit_code = exit_ok;
  add_wire(app, exit_code);
  try {
    app.parse("wire --samples 0 --rounds 0", false);
    FAIL() << "measured";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--samples 0"));
    EXPECT_THAT(error.what(), HasSubstr("give --samples 1 or more"));
  }
  EXPECT_THROW(app.parse("wire --samples -1", false), CLI::ParseError);
}

}  // namespace
}  // namespace palpate::bench
