#include "physics_node/record/catch_up.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "common/error/error.h"
#include "common/report/commit.h"
#include "common/scene/scene.h"
#include "physics_node/record/replay.h"

namespace palpate::physics {
namespace {

double reached(const SessionRecord& session, double at, double frame_seconds) {
  const double held = static_cast<double>(session.frames()) * frame_seconds;
  if (std::isinf(at)) return held;
  if (at > held + 0.5 * frame_seconds)
    throw InputError(
        fmt::format("{}: holds {:.3f} s and cannot begin at {:.6g} s", session.path(), held, at));
  return at;
}

[[noreturn]] void refuse(const SessionRecord& session, const World& world,
                         const Replay::Difference& difference) {
  const std::string own = commit();
  throw InputError(fmt::format(
      "{}: another state than that of {} after {:.3f} s; {}", world.scene().path, session.path(),
      difference.t,
      own == session.commit()
          ? "is it another scene, or are settings (--set) others than then?"
          : fmt::format("the record is of commit {}, this palpate of {}", session.commit(), own)));
}

}  // namespace

double time_in_record(const std::string& record, double at, double frame_seconds) {
  return reached(SessionRecord(record), at, frame_seconds);
}

CaughtUp catch_up(const std::string& record, double at, World& world, Recorder* recorder,
                  const std::function<bool()>& goes_on) {
  SessionRecord session(record);
  const double until = reached(session, at, world.frame_seconds());
  Replay replay(session, world);
  if (replay.difference()) refuse(session, world, *replay.difference());
  auto command = session.commands().begin();
  while (world.t() < until - 0.5 * world.frame_seconds() && goes_on()) {
    const auto frame = static_cast<std::uint64_t>(world.report().frames);
    for (; command != session.commands().end() && command->frame <= frame; ++command)
      if (recorder != nullptr) recorder->command(world, command->command);
    const bool moved = replay.frame();
    if (replay.difference()) refuse(session, world, *replay.difference());
    if (!moved) break;  // what the world stopped at in the record
    if (recorder != nullptr) recorder->frame(world, replay.hands());
  }
  const std::vector<std::optional<ToolState>> nobody(world.n_tools());
  world.frame(nobody);
  if (recorder != nullptr) recorder->frame(world, nobody);
  return {world.t(), replay.compared()};
}

}  // namespace palpate::physics
