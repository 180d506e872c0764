#include "physics_node/record/session_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/report/commit.h"
#include "common/scene/force_model.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/hand_play.h"

namespace palpate::physics {
namespace {

std::vector<std::uint8_t> bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw InputError(path + ": cannot be read; check its permissions");
  return bytes;
}

}  // namespace

SessionLog::SessionLog(const World& world, const SceneSource& source, Hdf5File& file)
    : file_(file),
      entries_(std::make_unique<SpscRing<Entry, n_entries>>()),
      told_(world.n_tools()),
      played_(world.n_tools(), 0),
      hashes_(make_rows<std::uint64_t>("/session/hashes", 2)),
      breaks_(make_rows<std::uint64_t>("/session/breaks", 3)),
      commands_(make_rows<std::uint64_t>("/session/commands", 3)),
      flushed_(make_rows<std::uint64_t>("/session/flushed", 1)),
      command_values_(make_rows<double>("/session/command_values", 1)),
      status_(make_rows<double>("/session/status", 6)),
      command_names_(make_rows<std::uint8_t>("/session/command_names", 64)) {
  keep_source(source);
  for (const ToolSpec& tool : world.scene().tools) {
    input_index_.push_back(make_rows<std::uint64_t>("/session/inputs/" + tool.name + "/index", index_width));
    const std::string base = "/session/inputs/" + tool.name;
    input_state_.push_back(make_rows<double>(base + "/state", state_width));
    motion_.emplace_back();
    spring_.push_back({base + "/spring", spring_width});
    samples_.push_back({base + "/samples", 3});
    if (force_model_of(tool) != ForceModel::tissue) continue;
    motion_.back() = make_rows<std::uint64_t>(base + "/motion", motion_width);
    make_rows<double>(base + "/spring", spring_width);
    make_rows<float>(base + "/samples", 3);
  }
  note_hash(world, 0);
}

void SessionLog::keep_source(const SceneSource& source) {
  const auto keep_text = [&](const std::string& path, const std::string& text) {
    file_.write<std::uint8_t>(path, {text.size()}, reinterpret_cast<const std::uint8_t*>(text.data()));
  };
  keep_text("/scene/text", source.text);
  std::string settings, files;
  for (const auto& setting : source.settings) settings += setting + "\n";
  std::uintmax_t kept = 0;
  for (std::size_t f = 0; f < source.files.size(); ++f) {
    const auto& [body, path, slice] = source.files[f];
    files += fmt::format("{}\t{}\t{}\n", body, slice ? "slice" : "volume",
                         std::filesystem::absolute(path).string());
    kept += std::filesystem::file_size(path);
    if (kept > most_kept_bytes) continue;  // found where it is, or not at all
    const auto bytes = bytes_of_file(path);
    file_.write<std::uint8_t>(fmt::format("/scene/file_{}", f), {bytes.size()}, bytes.data());
  }
  keep_text("/scene/settings", settings);
  keep_text("/scene/files", files);
}

template <class T>
SessionLog::Rows<T> SessionLog::make_rows(const std::string& path, std::uint64_t width) {
  file_.make_series<T>(path, {width});
  return {path, width};
}

template <class T>
void SessionLog::append(Rows<T>& rows) {
  if (rows.values.empty()) return;
  file_.append(rows.path, rows.values.data(), rows.values.size() / rows.width);
  rows.values.clear();
}

bool SessionLog::has_room() const noexcept {
  return lost_ || entries_->size() + told_.size() + 8 < n_entries;
}

void SessionLog::push(const Entry& entry) noexcept { lost_ = lost_ || !entries_->push(entry); }

void SessionLog::note_hash(const World& world, std::uint64_t frames) noexcept {
  Entry entry{.kind = Entry::Kind::hash, .frame = frames, .state = {}};
  entry.counts[0] = world.state_hash();
  push(entry);
}

void SessionLog::frame(const World& world, std::span<const std::optional<ToolState>> hands) noexcept {
  if (lost_) return;
  const auto done = static_cast<std::uint64_t>(world.report().frames);
  for (std::uint32_t n = 0; n < told_.size() && n < hands.size(); ++n) {
    const auto& hand = hands[n];
    auto& told = told_[n];
    const bool same =
        told ? told->fresh == hand.has_value() &&
                   (!hand || (told->state.tick == hand->tick && told->state.stamp_ns == hand->stamp_ns))
             : !hand;
    if (same) continue;
    told = Entry{.kind = Entry::Kind::input,
                 .tool = n,
                 .frame = done - 1,
                 .fresh = hand.has_value(),
                 .state = hand.value_or(ToolState{})};
    told->state.n_before = new_samples(told->state, played_[n]);
    if (told->state.sample > 0) played_[n] = told->state.sample;
    push(*told);
  }
  const StepReport& report = world.report();
  if (report.broken != broken_ || report.restored != restored_) {
    broken_ = report.broken;
    restored_ = report.restored;
    push({.kind = Entry::Kind::breaks,
          .frame = done,
          .state = {},
          .counts = {static_cast<std::uint64_t>(broken_), static_cast<std::uint64_t>(restored_)}});
  }
  if (report.frames % frames_between_hashes == 0) note_hash(world, done);
  push({.kind = Entry::Kind::done, .frame = done, .state = {}});
}

void SessionLog::command(const World& world, const Command& command) noexcept {
  if (lost_) return;
  Entry entry{
      .kind = Entry::Kind::command, .frame = static_cast<std::uint64_t>(world.report().frames), .state = {}};
  entry.counts = {static_cast<std::uint64_t>(command.kind), command.id};
  entry.numbers[0] = command.value;
  std::copy(command.name.begin(), command.name.end(), entry.name.begin());
  push(entry);
}

void SessionLog::status(const NodeStatus& status) noexcept {
  if (lost_) return;
  Entry entry{.kind = Entry::Kind::status, .state = {}};
  entry.numbers = {status.t,
                   status.rate_Hz,
                   status.real_time_factor,
                   static_cast<double>(status.late),
                   static_cast<double>(status.samples_lost),
                   static_cast<double>(status.warnings)};
  push(entry);
}

void SessionLog::end(const World& world) noexcept {
  if (!lost_ && world.report().frames % frames_between_hashes != 0)
    note_hash(world, static_cast<std::uint64_t>(world.report().frames));
}

void SessionLog::take(const Entry& entry) {
  const ToolState& state = entry.state;
  switch (entry.kind) {
    case Entry::Kind::input: {
      auto& index = input_index_[entry.tool].values;
      index.insert(index.end(), {entry.frame, entry.fresh ? 1U : 0U, state.tick,
                                 static_cast<std::uint64_t>(state.stamp_ns), state.contact_set, state.buttons,
                                 state.engaged});
      auto& numbers = input_state_[entry.tool].values;
      numbers.insert(numbers.end(), state.p_WT.begin(), state.p_WT.end());
      numbers.insert(numbers.end(), state.q_WT.begin(), state.q_WT.end());
      for (const Array3& part :
           {state.v_WT, state.w_WT, state.proxy, state.force_on_hand, state.force_now, state.torque_now})
        numbers.insert(numbers.end(), part.begin(), part.end());
      if (auto& motion = motion_[entry.tool]) {
        motion->values.insert(motion->values.end(), {state.sample, state.n_before});
        auto& spring = spring_[entry.tool].values;
        spring.insert(spring.end(), {state.stiffness, state.damping, state.force_limit});
        auto& samples = samples_[entry.tool].values;
        for (std::uint32_t n = 0; n < state.n_before; ++n)
          samples.insert(samples.end(), state.before[n].begin(), state.before[n].end());
      }
      break;
    }
    case Entry::Kind::hash:
      hashes_.values.insert(hashes_.values.end(), {entry.frame, entry.counts[0]});
      break;
    case Entry::Kind::breaks:
      breaks_.values.insert(breaks_.values.end(), {entry.frame, entry.counts[0], entry.counts[1]});
      break;
    case Entry::Kind::command:
      commands_.values.insert(commands_.values.end(), {entry.frame, entry.counts[0], entry.counts[1]});
      command_values_.values.push_back(entry.numbers[0]);
      command_names_.values.insert(command_names_.values.end(), entry.name.begin(), entry.name.end());
      break;
    case Entry::Kind::status:
      status_.values.insert(status_.values.end(), entry.numbers.begin(), entry.numbers.end());
      break;
    case Entry::Kind::done:
      complete_ = entry.frame;
      break;
  }
}

void SessionLog::write() {
  for (Entry entry; entries_->pop(entry);) take(entry);
  for (auto& rows : input_index_) append(rows);
  for (auto& rows : input_state_) append(rows);
  for (auto& rows : motion_)
    if (rows) append(*rows);
  for (auto& rows : spring_) append(rows);
  for (auto& rows : samples_) append(rows);
  for (auto* rows : {&hashes_, &breaks_, &commands_}) append(*rows);
  append(command_values_);
  append(command_names_);
  append(status_);
}

void SessionLog::flush() {
  file_.flush();
  flushed_.values.push_back(complete_);
  append(flushed_);
  file_.flush();
}

}  // namespace palpate::physics
