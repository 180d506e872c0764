#pragma once
// The three nodes: their names, their programs, and the order in which they are stopped.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/message/messages.h"

namespace palpate::deploy {

inline constexpr std::array all_nodes = {NodeKind::physics, NodeKind::haptic, NodeKind::render};

/// Forces go to zero first, then the tissue may stop, then the picture.
inline constexpr std::array stop_order = {NodeKind::haptic, NodeKind::physics, NodeKind::render};

/// "physics", "haptic", "render"; also the name of the node's part file and of its program after "palpate-".
std::string_view name_of(NodeKind node);

/// From "physics,haptic"; each at most once, order does not matter.
/// @throws InputError on any other word, or none
std::vector<NodeKind> parse_nodes(const std::string& list);

/// Which nodes one PC starts and which it expects elsewhere.
struct Share {
  std::vector<NodeKind> here;
  std::vector<NodeKind> elsewhere;
};

/// What --deployment, --side and --nodes say together.
///   all  everything here
///   p2   PC 1 renders; PC 2 has physics and haptics
///   p3   PC 1 has physics and renders; PC 2 the hand
/// `nodes` (nothing: not given) names the nodes of this PC in any other assignment; the others are expected elsewhere if
/// `beyond` says that the session goes beyond this machine.
/// @throws InputError on what cannot be
Share parse_share(const std::string& deployment, int side, const std::optional<std::string>& nodes,
                  bool beyond);

/// The same for a scene without a tool, which has nothing for a hand to do.
/// @throws InputError if nothing is left for this PC
Share without_hand(Share share);

}  // namespace palpate::deploy
