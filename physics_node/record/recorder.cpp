#include "physics_node/record/recorder.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/message/vec3.h"
#include "common/scene/record_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
Recorder::Recorder(const World& world, const SceneSource& source, const std::string& folder,
                   WhenBehind when_behind)
    : folder_(folder),
      when_behind_(when_behind),
      spec_(*world.scene().record),
      rows_(std::make_unique<SpscRing<ToolRow, 16384>>()),
      energy_rows_(std::make_unique<SpscRing<EnergyRow, 1024>>()) {
  for (const auto& tool : world.scene().tools) tool_names_.push_back(tool.name);
  tallies_.resize(tool_names_.size());
  make_files(world, source);
  if (spec_.positions) {
    for (std::size_t b = 0; b < world.n_bodies(); ++b)
      conditions_.emplace_back(static_cast<std::size_t>(world.body(b).body().n_nodes()));
    for (std::size_t s = 0; s < n_snapshots; ++s) {
      auto snapshot = std::make_unique<Snapshot>();
      for (std::size_t b = 0; b < world.n_bodies(); ++b) {
        const auto n = static_cast<std::size_t>(world.body(b).body().n_nodes());
        snapshot->position.emplace_back(3 * n);
        snapshot->flags.emplace_back(n);
        const std::size_t n_yielding = may_change_for_good(world.body(b).body()) ? n : 0;
        snapshot->yielded.emplace_back(n_yielding);
        snapshot->live.emplace_back(n_yielding);
      }
      snapshots_.push_back(std::move(snapshot));
    }
  }
  thread_ = std::thread([this] { work(); });
}

Recorder::~Recorder() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  for (std::FILE* file : csv_) std::fclose(file);
}

std::string Recorder::trace_name(const std::string& tool) { return "tool_" + tool + ".csv"; }

double Recorder::force_rms(std::size_t tool) const {
  const Tally& tally = tallies_[tool];
  return tally.rows == 0 ? 0 : std::sqrt(tally.squares / static_cast<double>(tally.rows));
}

void Recorder::frame(const World& world, std::span<const std::optional<ToolState>> hands) noexcept {
  while (!session_->has_room() && wait()) {
  }
  session_->frame(world, hands);
  note_tools(world);
  if (spec_.energy) note_energy(world);
  if (spec_.positions) note_positions(world);
}

bool Recorder::wait() const noexcept {
  if (when_behind_ == WhenBehind::drop || failed_) return false;
  std::this_thread::sleep_for(std::chrono::microseconds(200));
  return true;
}

bool Recorder::is_due(const World& world, std::int64_t& n) const noexcept {
  if (world.t() + 1e-9 < static_cast<double>(n) / spec_.rate_Hz) return false;
  ++n;
  return true;
}

void Recorder::note_tools(const World& world) noexcept {
  for (std::uint32_t n = 0; n < tallies_.size(); ++n) {
    const Tool& tool = world.tool(n);
    const Wrench now = tool.wrench(), raw = tool.raw_wrench();
    ToolRow row{n,
                tool.contacts(),
                world.t(),
                array(tool.tip()),
                array(now.force),
                array(now.moment),
                array(raw.force),
                array(raw.moment)};
    Tally& tally = tallies_[n];
    tally.peak = std::max(tally.peak, now.force.norm());
    tally.moment_peak = std::max(tally.moment_peak, std::hypot(row.moment[0], row.moment[1], row.moment[2]));
    tally.squares += now.force.squaredNorm();
    tally.contacts_max = std::max(tally.contacts_max, row.contacts);
    ++tally.rows;
    if (!spec_.forces) continue;
    bool taken = rows_->push(row);
    while (!taken && wait()) taken = rows_->push(row);
    dropped_ += taken ? 0 : 1;
  }
}

void Recorder::note_energy(const World& world) noexcept {
  if (!is_due(world, energies_due_)) return;
  const EnergyRow row{world.t(), world.watched_ledger()};
  bool taken = energy_rows_->push(row);
  while (!taken && wait()) taken = energy_rows_->push(row);
  dropped_ += taken ? 0 : 1;
}

void Recorder::note_positions(const World& world) noexcept {
  if (!is_due(world, snapshots_due_)) return;
  Snapshot& snapshot = *snapshots_[next_snapshot_];
  while (snapshot.full && wait()) {
  }
  if (snapshot.full) {
    ++dropped_;
    return;
  }
  take_snapshot(world, snapshot);
}

/// The end is what a person looks at first: it is not left to the rate.
void Recorder::note_end(const World& world) noexcept {
  if (!spec_.positions || world.t() <= snapshot_t_ + 1e-9) return;
  Snapshot& snapshot = *snapshots_[next_snapshot_];
  while (snapshot.full && !failed_)
    std::this_thread::sleep_for(std::chrono::microseconds(200));  // it is being written
  if (!snapshot.full) take_snapshot(world, snapshot);
}

void Recorder::take_snapshot(const World& world, Snapshot& snapshot) noexcept {
  snapshot.t = snapshot_t_ = world.t();
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    std::size_t n = 0;
    const auto masses = world.body(b).body().nodes();
    world.body(b).conditions(masses, conditions_[b]);
    for (const Index cell : masses) {
      const Vec3 p = world.body(b).position(cell);
      for (int a = 0; a < 3; ++a)
        snapshot.position[b][3 * n + static_cast<std::size_t>(a)] = static_cast<float>(p[a]);
      if (!snapshot.live[b].empty()) {
        snapshot.live[b][n] = world.body(b).adjacency().live_elements(cell);
        snapshot.yielded[b][n] = static_cast<std::uint8_t>(255 * conditions_[b][n].yielded_share + 0.5);
      }
      snapshot.flags[b][n] = conditions_[b][n].flags;
      ++n;
    }
  }
  snapshot.full = true;
  next_snapshot_ = (next_snapshot_ + 1) % n_snapshots;
}

}  // namespace palpate::physics
