// palpate reset TOOL: ends a latched fault of its device in the session that is running

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "common/error/error.h"
#include "common/time/clock.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {
namespace {

using namespace std::chrono_literals;
constexpr auto longest_wait = 3s;

struct ResetOptions {
  std::string tool;
  int domain = 0;
};

/// Waits for a haptic node to be there, tells it, and waits until it has had the time to hear.
int reset(const ResetOptions& options) {
  Command command;
  if (options.tool.size() >= command.name.size())
    throw InputError(fmt::format("\"{}\": the name of a tool has at most {} characters", options.tool,
                                 command.name.size() - 1));
  Participant participant(options.domain);
  Reader<NodeStatus> statuses(participant);
  Writer<Command> commands(participant);
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  bool heard = false;
  while (!heard && std::chrono::steady_clock::now() < end) {
    statuses.wait(50ms);
    for (NodeStatus status; statuses.take(status);) heard = heard || status.node == NodeKind::haptic;
  }
  if (!heard)
    throw InputError(
        fmt::format("no haptic node in domain {}; give the --domain of the session", options.domain));
  command.kind = CommandKind::device;
  command.value = 1;
  command.id = static_cast<std::uint64_t>(now_ns());
  std::copy(options.tool.begin(), options.tool.end(), command.name.begin());
  while (commands.matched() == 0 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
  if (!commands.write(command)) throw InputError("the command could not be sent");
  std::this_thread::sleep_for(200ms);
  std::printf("asked %s to open its device anew\n", options.tool.c_str());
  return exit_ok;
}

}  // namespace

void add_reset(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("reset", "open the device of a tool anew after a fault");
  auto options = std::make_shared<ResetOptions>();
  command->add_option("tool", options->tool, "name of the [[tool]]")->required();
  command->add_option("--domain", options->domain, "DDS domain of the session")->check(CLI::Range(0, 100));
  command->callback([options, &exit_code] { exit_code = reset(*options); });
}

}  // namespace palpate::deploy
