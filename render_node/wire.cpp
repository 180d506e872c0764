#include "render_node/wire.h"

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

/// Surfaces of a physics that was started again begin at revision 1, whatever was shown before.
bool Wire::drain_surfaces(ViewModel& model) {
  bool any = false;
  while (surfaces_.take(buffers_->surface)) {
    if (physics_ != 0 && surfaces_.sender() != physics_) model.begin_anew();
    physics_ = surfaces_.sender();
    model.take(buffers_->surface);
    any = true;
  }
  return any;
}

Wire::News Wire::take_into(ViewModel& model) {
  News news;
  news.anything |= drain_surfaces(model);
  news.anything |= drain(blocks_, buffers_->block, model);
  news.anything |= drain(wrenches_, buffers_->wrench, model);
  news.anything |= drain(traces_, buffers_->trace, model);
  news.anything |= drain(statuses_, buffers_->status, model);
  Command command;
  while (commands_.take(command)) {
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
      default:
        break;  // not about the eye
    }
  }
  news.paused = paused_;
  return news;
}

void Wire::command(CommandKind kind, double value) {
  Command command;
  command.id = ++last_command_;
  command.kind = kind;
  command.value = value;
  command_.write(command);
}

template <class M>
void Wire::count(Reader<M>& reader, NodeStatus& status) {
  const ReaderCounts counts = reader.counts();
  status.samples_received += counts.received;
  status.samples_lost += counts.lost;
  for (std::size_t i = 0; i < counts.rejected.size(); ++i) status.rejected[i] += counts.rejected[i];
}

void Wire::tell(NodeStatus status) {
  count(surfaces_, status);
  count(blocks_, status);
  count(wrenches_, status);
  count(traces_, status);
  count(statuses_, status);
  count(commands_, status);
  status_.write(status);
  unwelcome_ = unwelcome_ || newcomer_.must_go();
}

}  // namespace palpate::render
