#pragma once
// Whether the daemon of iceoryx, RouDi, lends this machine's processes its shared memory, through which Cyclone DDS then
// passes vertex blocks (topic.cpp says why only these). Nobody needs it: without RouDi everything goes over UDP.

#include <string>
#include <string_view>

namespace palpate {

enum class RouDi {
  absent,       // none answers
  unreachable,  // one runs, but its socket is not for this process: another user, or a private /tmp
  watching,     // one answers, and would abort a client that stands still for 1.5 s: never with a hand in it
  ready,        // one answers that leaves its clients alone (--monitoring-mode off)
  refused,      // PALPATE_SHARED_MEMORY=off in the environment
};

/// Asks the kernel who listens at RouDi's address and how it was started. Sends nothing. Cost: one look through /proc.
RouDi look_for_roudi();

/// Only whether one answers. Cost: one system call.
bool roudi_listens();

/// What was found, as a sentence that says what follows and what would be better.
std::string words(RouDi found);

/// `config` (loopback_config.h) with shared memory switched on.
std::string with_shared_memory(std::string_view config);

/// iceoryx says on std::cerr several times a second that RouDi has gone. From now on one line of each second passes. Call it once per process.
void tame_iceoryx_errors();

}  // namespace palpate
