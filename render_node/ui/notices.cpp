#include "render_node/ui/notices.h"

#include <fmt/format.h>

#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/model/hand_state.h"

namespace palpate::render {
namespace {

std::string note_of(const ViewModel& model, NodeKind kind) {
  const auto& status = model.node(kind);
  return status ? std::string(status->note.data()) : std::string();
}

std::string why_no_force(const HandState& hand, const std::string& tool, const ToolPointer* pointer,
                         bool pointed) {
  if (hand.state == "fault") return fmt::format("{}: device fault, no forces; Backspace opens it anew", tool);
  if (hand.state == "ready" || hand.state == "safe") {
    if (pointed && !pointer->held()) return fmt::format("{}: click on the tissue to take it", tool);
    if (!hand.reason.empty()) return fmt::format("{}: no force yet: {}", tool, hand.reason);
  }
  if (hand.state == "stale") return fmt::format("{}: no force: physics is silent", tool);
  return {};
}

std::string why_nothing_is_seen(const ViewModel& model) {
  const auto& physics = model.node(NodeKind::physics);
  if (!physics) return "loading: waiting for physics";
  return physics->phase == NodePhase::loading ? "loading the tissue" : "loading: waiting for its surface";
}

}  // namespace

std::vector<std::string> hindrances(const Scene& scene, const ViewModel& model, bool paused,
                                    const ToolPointer* pointer) {
  std::vector<std::string> lines;
  if (!model.anything_to_see()) lines.push_back(why_nothing_is_seen(model));
  if (paused) lines.emplace_back("paused: P goes on");
  const std::string note = note_of(model, NodeKind::haptic);
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    const bool pointed = pointer != nullptr && pointer->tool() == i;
    const std::string line =
        why_no_force(hand_state(note, scene.tools[i].name), scene.tools[i].name, pointer, pointed);
    if (!line.empty()) lines.push_back(line);
  }
  if (model.path_is_over()) lines.emplace_back("the hand's path is over; Esc ends");
  return lines;
}

}  // namespace palpate::render
