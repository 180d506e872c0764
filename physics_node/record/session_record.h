#pragma once
// Reads what SessionLog has left. Rows are read in blocks, so that a long session needs no more memory than a short one.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/record/hdf5_file.h"
#include "common/scene/scene.h"
#include "common/scene/scene_source.h"

namespace palpate::physics {

struct RecordedHash {
  std::uint64_t frame = 0;  // frames done
  std::uint64_t hash = 0;   // of the state then
};
struct RecordedCommand {
  std::uint64_t frame = 0;  // frames done before it acts
  Command command{};
};

class SessionRecord {
 public:
  /// Checks every dataset of the file. @throws InputError: no record of a session, or damaged: names file and dataset
  explicit SessionRecord(const std::string& path);

  const std::string& path() const noexcept { return path_; }
  /// Frames that can be run again: all, unless the writer was killed or fell behind.
  std::uint64_t frames() const noexcept { return frames_; }
  /// The writer has not closed the file.
  bool cut_short() const noexcept { return file_->cut_short(); }
  const std::string& commit() const noexcept { return commit_; }
  const std::vector<RecordedHash>& hashes() const noexcept { return hashes_; }
  const std::vector<RecordedCommand>& commands() const noexcept { return commands_; }

  /// The scene as it was run; the files that it names are laid out in `folder` first.
  /// @throws InputError: a file that the record does not hold is not where it was
  struct LaidOut {
    Scene scene;
    SceneSource source;
  };
  LaidOut lay_out(const std::string& folder) const;

  /// What physics got from the hands in frame `frame`. Call it for frames in order, from 0 on.
  /// @param tools  of the scene, in order; out: the newest state of each, absent where its hand was silent
  /// @throws InputError: a tool that the record has no hand of
  void inputs(std::uint64_t frame, const std::vector<ToolSpec>& specs,
              std::span<std::optional<ToolState>> tools);

 private:
  struct Track {
    std::uint64_t n_rows = 0, next = 0, block_first = 0;
    std::vector<std::uint64_t> index{};
    std::vector<double> state{};
    bool pressed_by_motion = false;
    std::uint64_t samples_read = 0;
    std::vector<std::uint64_t> motion{};
    std::vector<double> spring{};
    std::optional<ToolState> now{};
  };
  std::string text_of(const std::string& dataset) const;
  void read_block(const std::string& tool, Track& track) const;
  void read_motion(const std::string& tool, std::uint64_t row, Track& track) const;

  std::string path_;
  std::unique_ptr<Hdf5File> file_;
  std::string commit_;
  std::uint64_t frames_ = 0;
  std::vector<RecordedHash> hashes_;
  std::vector<RecordedCommand> commands_;
  std::vector<Track> tracks_;
};

}  // namespace palpate::physics
