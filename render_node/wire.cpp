#include "render_node/wire.h"

#include <algorithm>

#include "common/report/log.h"

namespace palpate::render {

Wire::Wire(const Membership& membership) : participant_(membership) {}

template <class M>
bool Wire::drain(Reader<M>& reader, M& buffer, ViewModel& model) {
  bool any = false;
  while (reader.take(buffer)) {
    model.take(buffer);
    any = true;
  }
  return any;
}

/// A physics that was started again numbers its surfaces from revision 1 on, whatever was shown before. What it sent while
/// nobody was sure of it was not taken: new readers get all of it again.
void Wire::follow_physics(ViewModel& model) {
  const std::uint64_t changes = physics_.changes();
  if (changes == physics_changes_) return;
  const bool another = physics_changes_ > 0;
  physics_changes_ = changes;
  if (!another) return;
  model.begin_anew();
  surfaces_before_ = sum(surfaces_before_, surfaces_->counts());
  changes_before_ = sum(changes_before_, changes_->counts());
  blocks_before_ = sum(blocks_before_, blocks_->counts());
  surfaces_ = std::make_unique<Reader<BodySurface>>(participant_, &physics_);
  changes_ = std::make_unique<Reader<SurfaceChange>>(participant_, &physics_);
  blocks_ = std::make_unique<Reader<VertexBlock>>(participant_, &physics_);
}

/// Each node tells of itself.
bool Wire::drain_statuses(ViewModel& model) {
  bool any = false;
  while (statuses_.take(buffers_->status)) {
    const NodeKind node = buffers_->status.node;
    if (node == NodeKind::physics && !statuses_.is_from(physics_)) continue;
    if (node == NodeKind::haptic && !statuses_.is_from(hand_)) continue;
    model.take(buffers_->status);
    any = true;
  }
  return any;
}

Wire::News Wire::take_into(ViewModel& model) {
  News news;
  news.anything |= drain_statuses(model);
  news.anything |= drain(wrenches_, buffers_->wrench, model);
  follow_physics(model);
  news.anything |= drain(*surfaces_, buffers_->surface, model);
  news.anything |= drain(*changes_, buffers_->change, model);
  news.anything |= drain(*blocks_, buffers_->block, model);
  news.anything |= drain(traces_, buffers_->trace, model);
  follow_physics(model);
  if (model.memory_refused() > 0 && !memory_told_) {
    memory_told_ = true;
    log_warn("not all of the surfaces is shown: they would take more than {} MB", MemoryBudget::most >> 20U);
  }
  Command command;
  for (int n = 0; n < most_commands && commands_.take(command); ++n) {
    switch (command.kind) {
      case CommandKind::stop:
        news.stop = true;
        break;
      case CommandKind::pause:
        paused_ = true;
        break;
      case CommandKind::resume:
        paused_ = false;
        break;
      case CommandKind::threshold:
        news.threshold = command.value;
        break;
      case CommandKind::colour:
        if (const auto kind = colour_kind_of(command.name.data())) news.colour = kind;
        break;
      case CommandKind::section:
        news.section = section_of(command.name.data(), command.value);
        break;
      case CommandKind::inside:
        news.inside = inside_of(command.name.data(), command.value);
        break;
      default:
        break;  // not about the eye
    }
  }
  news.paused = paused_;
  return news;
}

void Wire::command(CommandKind kind, double value, const std::string& name) {
  Command command;
  command.id = ++last_command_;
  command.kind = kind;
  command.value = value;
  std::copy_n(name.begin(), std::min(name.size(), command.name.size() - 1), command.name.begin());
  command_.write(command);
}

std::vector<Heard> Wire::heard() {
  return {{"BodySurface", sum(surfaces_before_, surfaces_->counts())},
          {"SurfaceChange", sum(changes_before_, changes_->counts())},
          {"VertexBlock", sum(blocks_before_, blocks_->counts())},
          {"ToolWrench", wrenches_.counts()},
          {"HapticTrace", traces_.counts()},
          {"NodeStatus", statuses_.counts()},
          {"Command", commands_.counts()}};
}

void Wire::tell(NodeStatus status) {
  clear_counts(status);
  for (const Heard& one : heard()) add_counts(status, one.counts);
  status.warnings += status.refused[0] == '\0' ? 0 : 1;
  status_.write(status);
  for (Speaker* speaker : {&physics_, &hand_, &people_})
    for (const auto& line : speaker->remarks()) log_warn("{}", line);
  unwelcome_ = unwelcome_ || newcomer_.must_go();
}

}  // namespace palpate::render
