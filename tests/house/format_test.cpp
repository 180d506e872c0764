// Every file is as .clang-format has it.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <tuple>

namespace palpate::house {
namespace {

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
  pclose(pipe);
  return text;
}

/// Files below `folder` that clang-format would change, one a line.
std::set<std::string> unformatted(const std::string& folder, const std::string& style) {
  const auto complaints =
      output_of("cd '" + folder +
                "' && find . \\( -path ./build -o -path ./out -o -path ./.git \\) -prune -o \\( -name '*.h' "
                "-o -name '*.cpp' -o -name '*.inl' \\) "
                "-print0 | xargs -0 clang-format --style='" +
                style + "' --dry-run 2>&1 | grep 'not clang-formatted\\|should be clang-formatted'");
  std::set<std::string> files;
  for (std::size_t at = 0; at < complaints.size();) {
    const auto end = complaints.find('\n', at);
    files.insert(complaints.substr(at, complaints.find(':', at) - at));
    at = end == complaints.npos ? complaints.size() : end + 1;
  }
  return files;
}

class Format : public testing::Test {
 protected:
  void SetUp() override {
    const auto version = output_of("clang-format --version 2>&1");
    ASSERT_NE(version.find("clang-format version"), version.npos) << "install the package clang-format";
    // Versions format differently: the number is that of Debian 12.
    if (version.find(" 14.") == version.npos)
      GTEST_SKIP() << "formatted with clang-format 14, this is " << version;
  }
};

TEST_F(Format, EveryFileHasTheStyle) {
  const char* root = std::getenv("PALPATE_SOURCE");
  ASSERT_NE(root, nullptr);
  std::string names;
  for (const auto& file : unformatted(root, "file")) names += "  " + file + "\n";
  EXPECT_EQ(names, "") << "format what you write: clang-format -i FILE";
}

TEST_F(Format, SeesAFileThatDiffers) {
  const std::string folder = testing::TempDir() + "/palpate_format_test";
  std::ignore = output_of("rm -rf '" + folder + "' && mkdir -p '" + folder + "'");
  std::ofstream(folder + "/good.h") << "int a;\n";
  EXPECT_TRUE(unformatted(folder, "Google").empty());
  std::ofstream(folder + "/bad.cpp") << "int   a ;int b;\n";
  EXPECT_EQ(unformatted(folder, "Google"), std::set<std::string>{"./bad.cpp"});
  std::ignore = output_of("rm -rf '" + folder + "'");
}

}  // namespace
}  // namespace palpate::house
