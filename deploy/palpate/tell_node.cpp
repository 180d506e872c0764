#include "deploy/palpate/tell_node.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "common/error/error.h"
#include "common/time/clock.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"

namespace palpate::deploy {

void tell_node(NodeKind node, Command command, int domain) {
  using namespace std::chrono_literals;
  constexpr auto longest_wait = 3s;
  Participant participant(domain);
  Reader<NodeStatus> statuses(participant);
  Writer<Command> commands(participant);
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  bool heard = false;
  while (!heard && std::chrono::steady_clock::now() < end) {
    statuses.wait(50ms);
    for (NodeStatus status; statuses.take(status);) heard = heard || status.node == node;
  }
  if (!heard)
    throw InputError(fmt::format("no {} node in domain {}; give the --domain of the session",
                                 node == NodeKind::haptic ? "haptic" : "physics", domain));
  command.id = static_cast<std::uint64_t>(now_ns());
  while (commands.matched() == 0 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
  if (!commands.write(command)) throw InputError("the command could not be sent");
  std::this_thread::sleep_for(200ms);
}

}  // namespace palpate::deploy
