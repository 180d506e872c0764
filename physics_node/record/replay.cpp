#include "physics_node/record/replay.h"

#include "common/message/tissue_reset.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {

Replay::Replay(SessionRecord& record, World& world)
    : record_(record), world_(world), hands_(world.n_tools()) {
  compare();
}

bool Replay::frame() {
  const auto frame = static_cast<std::uint64_t>(world_.report().frames);
  if (difference_ || frame >= record_.frames() || world_.has_stopped()) return false;
  const auto& commands = record_.commands();
  for (; next_command_ < commands.size() && commands[next_command_].frame <= frame; ++next_command_)
    if (const Command& command = commands[next_command_].command; is_undo(command))
      world_.undo();
    else if (command.kind == CommandKind::reset)
      world_.reset();  // the others move nothing
  record_.inputs(frame, world_.scene().tools, hands_);
  world_.frame(hands_);
  compare();
  return !difference_;
}

void Replay::compare() {
  const auto done = static_cast<std::uint64_t>(world_.report().frames);
  const auto& hashes = record_.hashes();
  if (next_hash_ >= hashes.size() || hashes[next_hash_].frame != done) return;
  const std::uint64_t found = world_.state_hash();
  ++compared_;
  if (found != hashes[next_hash_].hash)
    difference_ = Difference{done, world_.t(), hashes[next_hash_].hash, found};
  ++next_hash_;
}

}  // namespace palpate::physics
