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

}  // namespace palpate::deploy
