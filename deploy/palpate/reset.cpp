// palpate reset TOOL: ends a latched fault of its device in the session that is running
// palpate undo: its tissue as before the last stroke of a blade

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/error/error.h"
#include "common/message/tissue_reset.h"
#include "deploy/palpate/subcommands.h"
#include "deploy/palpate/tell_node.h"

namespace palpate::deploy {
namespace {

struct ResetOptions {
  std::string tool;
  int domain = 0;
};

int reset(const ResetOptions& options) {
  Command command{.kind = CommandKind::device, .value = 1};
  if (options.tool.size() >= command.name.size())
    throw InputError(fmt::format("\"{}\": the name of a tool has at most {} characters", options.tool,
                                 command.name.size() - 1));
  std::ranges::copy(options.tool, command.name.begin());
  tell_node(NodeKind::haptic, command, options.domain);
  std::printf("asked %s to open its device anew\n", options.tool.c_str());
  return exit_ok;
}

int undo(int domain) {
  Command command{.kind = CommandKind::reset};
  std::ranges::copy(last_stroke, command.name.begin());
  tell_node(NodeKind::physics, command, domain);
  std::printf("asked for the tissue as before the last stroke\n");
  return exit_ok;
}

void add_domain(CLI::App& command, int& domain) {
  command.add_option("--domain", domain, "DDS domain of the session")->check(CLI::Range(0, 100));
}

}  // namespace

void add_reset(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("reset", "open the device of a tool anew after a fault");
  auto options = std::make_shared<ResetOptions>();
  command->add_option("tool", options->tool, "name of the [[tool]]")->required();
  add_domain(*command, options->domain);
  command->callback([options, &exit_code] { exit_code = reset(*options); });
}

void add_undo(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("undo", "bring tissue back as it was before the last stroke of a blade");
  auto domain = std::make_shared<int>(0);
  add_domain(*command, *domain);
  command->callback([domain, &exit_code] { exit_code = undo(*domain); });
}

}  // namespace palpate::deploy
