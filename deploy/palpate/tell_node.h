#pragma once
// A command from the command line to a node of a session that is running.

#include "common/message/node_messages.h"

namespace palpate::deploy {

/// Waits for the node to be there, tells it, and waits until it has had the time to hear. @param command  without its id
/// @throws InputError  no such node in the domain within 3 s, or nobody listens
void tell_node(NodeKind node, Command command, int domain);

}  // namespace palpate::deploy
