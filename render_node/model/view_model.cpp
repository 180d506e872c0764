#include "render_node/model/view_model.h"

#include <algorithm>

#include "common/message/vec3.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/inside_spec.h"
#include "common/scene/scene.h"
#include "common/scene/section_spec.h"
#include "common/scene/tool_spec.h"
#include "render_node/model/hand_state.h"

namespace palpate::render {
ViewModel::ViewModel(const Scene& scene) : tools_(scene.tools.size()) {
  first_section_ = scene.bodies.size() + scene.connections.size();
  first_inside_ = first_section_ + bodies_with_section(scene).size();
  const std::size_t n = first_inside_ + bodies_with_inside(scene).size();
  bodies_.reserve(n);
  for (std::size_t i = 0; i < n; ++i) bodies_.emplace_back(budget_);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const DeviceSpec& device = scene.device(scene.tools[i].device);
    tools_[i].name = scene.tools[i].name;
    tools_[i].clock = HandClock(device.rate_Hz);
    if (device.driver == "simulated" && !device.waypoints.empty())
      tools_[i].path_s = device.waypoints.back().t;
  }
}

void ViewModel::begin_anew() noexcept {
  for (auto& body : bodies_) body.begin_anew();
}

template <class M>
void ViewModel::take_part(const M& part) {
  if (part.body >= bodies_.size()) {
    ++ignored_;
    return;
  }
  const auto fate = bodies_[part.body].take(part);
  if (fate != ChunkFate::kept && fate != ChunkFate::completed) ++ignored_;
}

void ViewModel::take(const BodySurface& chunk) { take_part(chunk); }
void ViewModel::take(const SurfaceChange& page) { take_part(page); }

void ViewModel::take(const VertexBlock& block) {
  if (block.body >= bodies_.size() || !bodies_[block.body].take(block)) {
    ++ignored_;
    return;
  }
  t_ = block.t;
}

void ViewModel::take(const ToolWrench& wrench) {
  if (wrench.tool >= tools_.size()) {
    ++ignored_;
    return;
  }
  ToolView& tool = tools_[wrench.tool];
  tool.answered = true;
  tool.force = vec(wrench.force);
  tool.moment = vec(wrench.moment);
  tool.set_point = vec(wrench.set_point);
  tool.tip_in_tissue = vec(wrench.tip);
  tool.stretch = wrench.stretch;
  tool.n_contacts = wrench.n_contacts;
  tool.attitude = Eigen::Quaterniond(wrench.q_WT[0], wrench.q_WT[1], wrench.q_WT[2], wrench.q_WT[3]);
  t_ = wrench.t;
  const auto when = tool.clock.at(wrench.answers);
  if (!when) return;  // no hand has been answered yet
  tool.on_tool.add(*when, tool.force.norm());
  for (std::size_t axis = 0; axis < 3; ++axis) tool.moment_history[axis].add(*when, wrench.moment[axis]);
}

void ViewModel::take(const HapticTrace& trace) {
  if (trace.tool >= tools_.size() || trace.n_samples > max_trace_samples) {
    ++ignored_;
    return;
  }
  ToolView& tool = tools_[trace.tool];
  for (std::uint32_t i = 0; i < trace.n_samples; ++i) {
    const TraceSample& sample = trace.samples[i];
    tool.clock.note(sample);
    tool.on_hand.add(sample.t, vec(sample.force).norm());
    tool.tip = vec(sample.p);
    tool.proxy = vec(sample.proxy);
    tool.energy = sample.energy;
  }
}

void ViewModel::take(const NodeStatus& status) {
  const auto kind = static_cast<std::size_t>(status.node);
  if (kind >= nodes_.size()) {
    ++ignored_;
    return;
  }
  nodes_[kind] = status;
  if (status.node == NodeKind::physics) t_ = status.t;
  if (status.node != NodeKind::haptic) return;
  for (ToolView& tool : tools_)
    if (!tool.path_began && !tool.on_hand.empty() && hand_state(status.note.data(), tool.name).state == "run")
      tool.path_began = tool.on_hand.newest();
}

bool ViewModel::path_is_over() const noexcept {
  return !tools_.empty() && std::all_of(tools_.begin(), tools_.end(), [](const ToolView& tool) {
    return tool.path_s > 0 && tool.path_began && tool.on_hand.newest() >= *tool.path_began + tool.path_s;
  });
}

void ViewModel::refresh() {
  for (auto& body : bodies_) body.refresh();
}

bool ViewModel::anything_to_see() const noexcept {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const BodyPicture& body) { return !body.empty(); });
}

Eigen::AlignedBox3d ViewModel::box() const {
  Eigen::AlignedBox3d box;
  for (const auto& body : bodies_) {
    if (!body.first_box().isEmpty()) box.extend(body.first_box().cast<double>());
  }
  return box;
}

std::size_t ViewModel::facets_visible() const noexcept {
  std::size_t n = 0;
  for (const auto& body : std::span(bodies_).first(first_section_)) n += body.facets_visible();
  return n;
}

std::size_t ViewModel::facets_total() const noexcept {
  std::size_t n = 0;
  for (const auto& body : std::span(bodies_).first(first_section_)) n += body.facets_total();
  return n;
}

}  // namespace palpate::render
