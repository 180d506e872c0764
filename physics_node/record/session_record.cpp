#include "physics_node/record/session_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "common/error/error.h"
#include "common/record/check_file.h"
#include "common/record/dataset_list.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/record/session_log.h"

namespace palpate::physics {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t block_rows = 4096;
// Of lists that a session keeps as a whole. Why: two numbers a second, and what people do, in a year and more.
constexpr std::uint64_t most_numbers = 1 << 26;
constexpr std::uint64_t most_scene_bytes = 1 << 24;  // sixteen times what a scene file may have
constexpr std::uint64_t most_list_bytes = 1 << 24;   // of settings, and of the names of files

/// What a scene cannot need is refused before it is read, so before the file is checked as well.
void refuse_excess(const std::string& path) {
  const std::map<std::string, std::uint64_t> most = {
      {"/scene/text", most_scene_bytes},         {"/scene/settings", most_list_bytes},
      {"/scene/files", most_list_bytes},         {"/session/flushed", most_numbers},
      {"/session/hashes", most_numbers},         {"/session/commands", most_numbers},
      {"/session/command_values", most_numbers}, {"/session/command_names", most_numbers}};
  for (const DatasetFacts& dataset : list_datasets(path)) {
    const auto known = most.find(dataset.path);
    const bool image = dataset.path.starts_with("/scene/file_");
    if (known == most.end() && !image) continue;
    const std::uint64_t limit = image ? most_kept_bytes : known->second;
    std::uint64_t numbers = 1;
    for (const auto extent : dataset.shape)
      numbers = extent > limit ? limit + 1 : std::min(numbers * extent, limit + 1);
    if (numbers > limit)
      throw InputError(
          fmt::format("{}: dataset {} has {} numbers; at most {} can be of a session; it is damaged", path,
                      dataset.path, fmt::join(dataset.shape, " x "), limit));
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

ToolState state_of(std::uint32_t tool, const std::uint64_t* index, const double* numbers) {
  ToolState state;
  state.tool = tool;
  state.tick = index[2];
  state.stamp_ns = static_cast<std::int64_t>(index[3]);
  state.contact_set = index[4];
  state.buttons = static_cast<std::uint32_t>(index[5]);
  state.engaged = static_cast<std::uint32_t>(index[6]);
  const auto take = [&](auto& part) {
    std::copy_n(numbers, part.size(), part.begin());
    numbers += part.size();
  };
  take(state.p_WT);
  take(state.q_WT);
  for (Array3* part :
       {&state.v_WT, &state.w_WT, &state.proxy, &state.force_on_hand, &state.force_now, &state.torque_now})
    take(*part);
  return state;
}

void write_bytes(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.flush();
  if (!out) throw InputError(path.string() + ": cannot be written; is the disk full?");
}

}  // namespace

SessionRecord::SessionRecord(const std::string& path) : path_(path) {
  if (!fs::is_regular_file(path)) throw InputError(path + ": no such file; give the record.h5 of a run");
  refuse_excess(path);
  check_file(path);
  try {
    file_ = std::make_unique<Hdf5File>(path, Hdf5File::Mode::read);
    if (!file_->has_attribute("palpate_record") || !file_->has("/session/hashes"))
      throw InputError(path +
                       ": is no record of a session; give the record.h5 of palpate run or palpate simulate");
    commit_ = file_->text("commit");
    const auto flushed = file_->read<std::uint64_t>("/session/flushed");
    frames_ = flushed.empty() ? 0 : flushed.back();
    const auto hashes = file_->read<std::uint64_t>("/session/hashes");
    for (std::size_t n = 0; n + 1 < hashes.size(); n += 2)
      if (hashes[n] <= frames_) hashes_.push_back({hashes[n], hashes[n + 1]});
    const auto commands = file_->read<std::uint64_t>("/session/commands");
    const auto values = file_->read<double>("/session/command_values");
    const auto names = file_->read<std::uint8_t>("/session/command_names");
    constexpr std::size_t width = std::tuple_size_v<decltype(Command::name)>;
    for (std::size_t n = 0; n < std::min({values.size(), commands.size() / 3, names.size() / width}); ++n) {
      RecordedCommand recorded{commands[3 * n], {}};
      recorded.command.kind = static_cast<CommandKind>(commands[3 * n + 1]);
      recorded.command.id = commands[3 * n + 2];
      recorded.command.value = values[n];
      std::copy_n(names.data() + n * width, width - 1, recorded.command.name.begin());  // the last stays 0
      if (recorded.frame < frames_) commands_.push_back(recorded);
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& damaged) {
    throw InputError(damaged.what());
  }
}

std::string SessionRecord::text_of(const std::string& dataset) const {
  return file_->read_text(dataset, most_scene_bytes);
}

SessionRecord::LaidOut SessionRecord::lay_out(const std::string& folder) const {
  SceneSource source{
      .text = text_of("/scene/text"), .settings = lines_of(text_of("/scene/settings")), .files = {}};
  const auto files = lines_of(text_of("/scene/files"));
  for (std::size_t f = 0; f < files.size(); ++f) {
    std::istringstream line(files[f]);
    std::string body, kind, path;
    std::getline(std::getline(std::getline(line, body, '\t'), kind, '\t'), path);
    const std::string dataset = fmt::format("/scene/file_{}", f);
    if (file_->has(dataset)) {
      path =
          (fs::path(folder) / fmt::format("file_{:05}{}", f, fs::path(path).extension().string())).string();
      write_bytes(path, file_->read<std::uint8_t>(dataset, most_kept_bytes));
    }
    source.files.push_back({body, path, kind == "slice"});
  }
  auto settings = source.settings;
  for (auto& setting : settings_for_files(source)) settings.push_back(std::move(setting));
  Scene scene = parse_scene(source.text, path_ + ":/scene/text", settings);
  return {std::move(scene), std::move(source)};
}

void SessionRecord::read_block(const std::string& tool, Track& track) const {
  const std::string base = "/session/inputs/" + tool;
  track.block_first = track.next;
  const std::uint64_t n = std::min(block_rows, track.n_rows - track.next);
  track.index = file_->read_rows<std::uint64_t>(base + "/index", track.next, n, index_width);
  track.state = file_->read_rows<double>(base + "/state", track.next, n, state_width);
  if (!track.pressed_by_motion) return;
  track.motion = file_->read_rows<std::uint64_t>(base + "/motion", track.next, n, motion_width);
  track.spring = file_->read_rows<double>(base + "/spring", track.next, n, spring_width);
}

/// The samples of one state. They lie one after the other, whether its hand was there or not.
void SessionRecord::read_motion(const std::string& tool, std::uint64_t row, Track& track) const {
  const std::uint64_t n = track.motion[row * motion_width + 1];
  if (n > max_told_samples)
    throw InputError(
        fmt::format("{}: /session/inputs/{}/motion has {} samples in a state; at most {} can be; it is "
                    "damaged",
                    path_, tool, n, max_told_samples));
  const auto samples =
      file_->read_rows<float>("/session/inputs/" + tool + "/samples", track.samples_read, n, 3);
  track.samples_read += n;
  if (!track.now) return;
  ToolState& state = *track.now;
  state.sample = track.motion[row * motion_width];
  const double* spring = &track.spring[row * spring_width];
  state.stiffness = spring[0], state.damping = spring[1], state.force_limit = spring[2];
  state.n_before = static_cast<std::uint32_t>(n);
  for (std::size_t i = 0; i < n; ++i) std::copy_n(&samples[3 * i], 3, state.before[i].begin());
}

void SessionRecord::inputs(std::uint64_t frame, const std::vector<ToolSpec>& specs,
                           std::span<std::optional<ToolState>> tools) {
  if (frame == 0) tracks_.assign(specs.size(), {});
  for (std::size_t n = 0; n < tracks_.size(); ++n) {
    Track& track = tracks_[n];
    if (frame == 0) {
      const std::string base = "/session/inputs/" + specs[n].name;
      if (!file_->has(base + "/index") || !file_->has(base + "/state"))
        throw InputError(
            fmt::format("{}: knows no tool \"{}\"; it is of another scene", path_, specs[n].name));
      track.n_rows = std::min(file_->shape(base + "/index").at(0), file_->shape(base + "/state").at(0));
      track.pressed_by_motion = file_->has(base + "/motion");
    }
    while (track.next < track.n_rows) {
      if (track.next >= track.block_first + track.index.size() / index_width)
        read_block(specs[n].name, track);
      const std::uint64_t row = track.next - track.block_first;
      const std::uint64_t* index = &track.index[row * index_width];
      if (index[0] > frame) break;
      track.now.reset();
      if (index[1] != 0)
        track.now = state_of(static_cast<std::uint32_t>(n), index, &track.state[row * state_width]);
      if (track.pressed_by_motion) read_motion(specs[n].name, row, track);
      ++track.next;
    }
    tools[n] = track.now;
  }
}

}  // namespace palpate::physics
