// Files that differ from .clang-format may not become more. Their number stands in tests/house/unformatted_files.txt; whoever
// formats some takes it down.

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
      GTEST_SKIP() << "counted with clang-format 14, this is " << version;
  }
};

TEST_F(Format, NoFurtherFileDiffersFromTheStyle) {
  const std::string root = std::getenv("PALPATE_SOURCE");
  std::ifstream kept(root + "/tests/house/unformatted_files.txt");
  std::size_t most = 0;
  ASSERT_TRUE(kept >> most) << "tests/house/unformatted_files.txt has no number";
  const auto files = unformatted(root, "file");
  std::string names;
  for (const auto& file : files) names += "  " + file + "\n";
  EXPECT_LE(files.size(), most) << "format what you write: clang-format -i FILE. Now differ:\n" << names;
  if (files.size() < most)
    std::printf("only %zu files differ: write that number into tests/house/unformatted_files.txt\n",
                files.size());
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
