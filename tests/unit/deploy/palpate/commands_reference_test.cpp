// docs/reference/commands.md has every command and every option that --help names, and no others.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/reference/page.h"

namespace palpate::test {
namespace {

using Words = std::set<std::string>;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  char part[4096];
  for (std::size_t n; (n = fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  pclose(pipe);
  return text;
}

std::string program() {
  const char* folder = std::getenv("PALPATE_BIN");
  return std::string(folder == nullptr ? "build/ready/bin" : folder) + "/palpate";
}

struct Help {
  Words commands, options;
};

/// What stands at the beginning of the lines of a help text: "  -h,--help   ..." is --help, "  scene TEXT" is SCENE.
Help help_of(const std::string& command) {
  Help help;
  std::istringstream lines(output_of("'" + program() + "' " + command + " --help"));
  std::string part;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(":") && !line.starts_with(" ")) part = line;
    if (line.size() < 3 || !line.starts_with("  ") || line[2] == ' ') continue;
    std::string word = line.substr(2, line.find(' ', 2) - 2);
    word = word.substr(word.rfind(',') + 1);
    if (part == "Subcommands:") help.commands.insert(word);
    if (part == "Positionals:")
      for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (part != "Subcommands:" && word != "--help" && word != "--version") help.options.insert(word);
  }
  return help;
}

/// "run", "bench kernel", ...: as the headings of the page have them.
Words commands_of_program() {
  Words commands;
  for (const auto& command : help_of("").commands) {
    commands.insert(command);
    for (const auto& inner : help_of(command).commands) commands.insert(command + " " + inner);
  }
  return commands;
}

class CommandsReference : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(std::filesystem::exists(program())) << program() << " is not built";
    // Bench is left out of a build with PALPATE_BENCH=OFF.
    has_bench_ = std::filesystem::exists(program() + "-bench");
  }
  bool is_built(const std::string& command) const { return has_bench_ || !command.starts_with("bench"); }
  bool has_bench_ = false;
};

TEST_F(CommandsReference, HasTheOptionsOfEveryCommand) {
  Words asked;
  for (const auto& section : reference_page("docs/reference/commands.md")) {
    const std::string command = section.heading.substr(std::string("palpate ").size());
    if (!is_built(command)) continue;
    Words listed;
    for (const auto& row : section.rows) {
      listed.insert(row.at("option"));
      EXPECT_NE(row.at("meaning"), "") << command << " " << row.at("option");
    }
    EXPECT_EQ(listed, help_of(command).options) << command;
    asked.insert(command);
  }
  for (const auto& command : commands_of_program())
    EXPECT_TRUE(asked.contains(command) || !is_built(command) || help_of(command).options.empty())
        << command << " has no table";
}

TEST_F(CommandsReference, HasEveryCommand) {
  Words listed, built;
  for (const auto& heading : reference_headings("docs/reference/commands.md"))
    if (heading.starts_with("palpate ") && is_built(heading.substr(8))) listed.insert(heading.substr(8));
  for (const auto& command : commands_of_program())
    if (is_built(command)) built.insert(command);
  EXPECT_EQ(listed, built);
}

}  // namespace
}  // namespace palpate::test
