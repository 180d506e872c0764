#include "deploy/palpate/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/error/error.h"

namespace palpate::deploy {

std::string_view name_of(NodeKind node) {
  switch (node) {
    case NodeKind::physics:
      return "physics";
    case NodeKind::haptic:
      return "haptic";
    case NodeKind::render:
      return "render";
    case NodeKind::supervisor:
      return "supervisor";
  }
  return "unknown";
}

std::vector<NodeKind> parse_nodes(const std::string& list) {
  std::vector<NodeKind> nodes;
  std::stringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto* found =
        std::find_if(all_nodes.begin(), all_nodes.end(), [&](NodeKind n) { return name_of(n) == word; });
    if (found == all_nodes.end()) {
      throw InputError(fmt::format("--nodes: \"{}\" is not a node; choose from physics,haptic,render", word));
    }
    if (std::find(nodes.begin(), nodes.end(), *found) == nodes.end()) nodes.push_back(*found);
  }
  if (nodes.empty()) throw InputError("--nodes: names no node; choose from physics,haptic,render");
  return nodes;
}

Share parse_share(const std::string& deployment, int side, const std::optional<std::string>& nodes,
                  bool beyond) {
  Share share;
  if (deployment == "all") {
    if (side != 0) throw InputError("--side: only with --deployment p2 or p3");
    share.here = nodes ? parse_nodes(*nodes) : std::vector<NodeKind>(all_nodes.begin(), all_nodes.end());
    if (!beyond) return share;
  } else {
    if (nodes) throw InputError("--nodes: not together with --deployment; give one of them");
    if (side == 0) {
      throw InputError(fmt::format("--deployment {}: which PC is this? --side 1 {}, --side 2 {}", deployment,
                                   deployment == "p2" ? "renders" : "has physics and renders",
                                   deployment == "p2" ? "has physics and haptics" : "has the hand"));
    }
    using enum NodeKind;
    if (deployment == "p2") share.here = side == 1 ? std::vector{render} : std::vector{physics, haptic};
    if (deployment == "p3") share.here = side == 1 ? std::vector{physics, render} : std::vector{haptic};
  }
  for (const NodeKind node : all_nodes)
    if (std::find(share.here.begin(), share.here.end(), node) == share.here.end())
      share.elsewhere.push_back(node);
  return share;
}

Share without_hand(Share share) {
  std::erase(share.here, NodeKind::haptic);
  std::erase(share.elsewhere, NodeKind::haptic);
  if (share.here.empty())
    throw InputError("the scene has no [[tool]], so that this PC has nothing to do; add one");
  return share;
}

}  // namespace palpate::deploy
