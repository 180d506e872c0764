// clang-tidy has nothing to say about the rooms where files, wire and devices come in. PALPATE_TIDY=all looks at every room:
// some eight minutes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace palpate::house {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t files_at_once = 8;  // in one unit, since most of the time goes into headers

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
  pclose(pipe);
  return text;
}

std::string in_quotes(const std::string& word) {
  return "'" + std::regex_replace(word, std::regex("'"), "'\\''") + "'";
}

fs::path root() {
  const char* source = std::getenv("PALPATE_SOURCE");
  return source == nullptr ? fs::current_path() : fs::path(source);
}

/// How the files of a room are compiled: the folder where the compiler ran, flags of headers and language.
struct Compiler {
  std::string folder, flags;
};

/// Of the target that is nearest above the room. Whether the build compiles single files or whole rooms at once is the same here.
Compiler compiler_of(const std::string& room) {
  const char* bin = std::getenv("PALPATE_BIN");
  std::ifstream in(fs::path(bin == nullptr ? "." : bin) / "../compile_commands.json");
  const auto all = nlohmann::json::parse(in);
  for (fs::path above = room; !above.empty(); above = above.parent_path())
    for (const auto& entry : all) {
      const auto command = entry["command"].get<std::string>();
      if (command.find(" -o " + above.string() + "/CMakeFiles/") == command.npos) continue;
      Compiler compiler{entry["directory"].get<std::string>(), ""};
      // As CMake writes them: words apart, quoted where they must be.
      static const std::regex flag(R"re((-isystem |-I|-D|-std=)("(\\.|[^"])*"|\S+))re");
      for (std::sregex_iterator at(command.begin(), command.end(), flag), end; at != end; ++at)
        compiler.flags += at->str() + " ";
      return compiler;
    }
  return {};
}

/// Its sources. Kernels for one instruction set are left out: their flags are another machine's.
std::vector<fs::path> sources_of(const std::string& room) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root() / room))
    if (entry.path().extension() == ".cpp" && entry.path().string().find("_avx") == std::string::npos)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What is found, a line each.
std::string tidy(const fs::path& file, const Compiler& compiler) {
  const std::string all =
      output_of("cd " + in_quotes(compiler.folder) +
                " && clang-tidy --quiet --config-file=" + in_quotes((root() / ".clang-tidy").string()) +
                " --header-filter=" + in_quotes(root().string() + "/.*|.*/palpate_tidy_.*") + " " +
                in_quotes(file.string()) + " -- " + compiler.flags + " -Wno-everything");
  std::istringstream in(all);
  std::string found;
  for (std::string line; std::getline(in, line);)
    if (line.find(": warning:") != line.npos || line.find(": error:") != line.npos) found += line + "\n";
  return found;
}

class Tidy : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto version = output_of("clang-tidy --version");
    ASSERT_NE(version.find("LLVM version"), version.npos) << "install the package clang-tidy";
    if (version.find("version 14.") == version.npos)
      GTEST_SKIP() << "what each version finds differs; looked at with clang-tidy 14, this is " << version;
    std::string name = fs::temp_directory_path() / "palpate_tidy_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_P(Tidy, FindsNothing) {
  const auto files = sources_of(GetParam());
  const Compiler compiler = compiler_of(GetParam());
  ASSERT_FALSE(files.empty());
  ASSERT_NE(compiler.flags, "");
  for (std::size_t first = 0; first < files.size(); first += files_at_once) {
    const fs::path together = folder / "together.cpp";
    {
      std::ofstream out(together);
      for (std::size_t n = first; n < std::min(first + files_at_once, files.size()); ++n)
        out << "#include \"" << files[n].string() << "\"\n";
    }
    EXPECT_EQ(tidy(together, compiler), "");
  }
}

/// One fault of each kind that may not pass.
TEST_F(Tidy, SeesFaults) {
  const fs::path bad = folder / "bad.cpp";
  std::ofstream(bad)
      << "#include <cstring>\n#include <string>\n#include <utility>\n#include <vector>\n"
         "struct Base { virtual ~Base() = default; virtual int f() { return 0; } };\n"
         "struct Child : Base { virtual int f() { return 1; } };\n"
         "std::string moved(std::string a) { std::string b = std::move(a); return a + b; }\n"
         "unsigned long n(const char* t) { return sizeof(t) / sizeof(t[0]); }\n"
         "int copies(const std::vector<std::string>& all) {\n"
         "  int n = 0;\n  for (const auto one : all) n += one.empty() ? 0 : 1;\n  return n;\n}\n";
  const std::string found = tidy(bad, compiler_of("common/file"));
  for (const char* check : {"modernize-use-override", "bugprone-use-after-move", "bugprone-sizeof-expression",
                            "performance-for-range-copy"})
    EXPECT_NE(found.find(check), found.npos) << check << " is not among\n" << found;
}

std::vector<std::string> rooms() {
  const char* which = std::getenv("PALPATE_TIDY");
  if (which == nullptr || std::string(which) != "all")
    return {"common/file", "common/record",      "common/scene",
            "common/wire", "haptic_node/device", "haptic_node/loop"};
  std::vector<std::string> all;
  for (const char* top : {"common", "physics_node", "haptic_node", "render_node", "deploy"})
    for (const auto& entry : fs::recursive_directory_iterator(root() / top))
      if (entry.path().extension() == ".cpp")
        all.push_back(entry.path().parent_path().lexically_relative(root()).string());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Rooms, Tidy, testing::ValuesIn(rooms()), [](const auto& each) {
  return std::regex_replace(each.param, std::regex("/"), "_");
});

}  // namespace
}  // namespace palpate::house
