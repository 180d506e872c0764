#include "common/process/command_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/report/commit.h"
#include "common/scene/near_miss.h"

namespace palpate {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    if (!command->get_name().empty()) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const auto& name : option->get_lnames())
      if (!option->get_group().empty()) names.push_back("--" + name);
  return names;
}

/// The command that was chosen, as far as it was understood.
const CLI::App& chosen(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

/// @param extras  words that nobody wanted
std::string extras_text(const CLI::App& app, const std::vector<std::string>& extras) {
  const CLI::App& at = chosen(app);
  const auto commands = commands_of(at);
  const auto word = std::find_if(extras.begin(), extras.end(), [&](const std::string& extra) {
    return commands.empty() == extra.starts_with("-");
  });
  const std::string& extra = word == extras.end() ? extras.front() : *word;
  if (extra.starts_with("-")) {
    const std::string name = extra.substr(0, extra.find('='));
    if (const auto meant = near_miss(name, options_of(at)))
      return fmt::format("there is no option {}; did you mean {}?", name, *meant);
    return fmt::format("there is no option {}", name);
  }
  if (!commands.empty())
    return fmt::format("there is no command \"{}\"; {}", extra, advice(extra, commands, "commands"));
  return fmt::format("\"{}\" is one word too many", extra);
}

}  // namespace

std::string version_line(const std::string& program) {
  return fmt::format("{} {} (commit {})", program, version(), commit());
}

void add_version(CLI::App& app, const std::string& program) {
  app.set_version_flag("--version", version_line(program), "which version this is");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : ",") + word;
  return {[words](std::string& given) -> std::string {
            if (std::find(words.begin(), words.end(), given) != words.end()) return {};
            const auto meant = near_miss(given, words);
            return fmt::format(
                "there is no \"{}\"; {}", given,
                meant ? fmt::format("did you mean \"{}\"?", *meant) : "write " + quoted_list(words));
          },
          "{" + list + "}"};
}

std::string mistake_text(const CLI::App& app, const CLI::ParseError& error) {
  const auto extras = app.remaining(true);
  const bool unknown =
      std::any_of(extras.begin(), extras.end(), [](const auto& extra) { return extra.starts_with("-"); });
  // A mistyped option often makes another one seem to be missing.
  if (!extras.empty() && (unknown || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr))
    return extras_text(app, extras);
  return error.what();
}

}  // namespace palpate
