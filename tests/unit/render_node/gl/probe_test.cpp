#include "render_node/gl/probe.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace palpate::render {
namespace {

TEST(ProbeGl, NamesTheRenderer) {
  std::string what;
  ASSERT_TRUE(probe_gl(what)) << what;
  EXPECT_NE(what.find("OpenGL"), std::string::npos) << what;
}

TEST(ProbeGl, SaysWhatToInstallWhereNothingDraws) {
  // In a child: EGL remembers its vendors for the life of a process.
  const auto without_vendors = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
    std::string what;
    const bool drew = probe_gl(what);
    std::fprintf(stderr, "%s\n", what.c_str());
    std::exit(drew ? 0 : 3);
  };
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(without_vendors(), testing::ExitedWithCode(3), "install libegl1");
}

}  // namespace
}  // namespace palpate::render
