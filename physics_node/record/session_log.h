#pragma once
// What a session must leave for it to be run again: the scene with its files, the states of the hands as physics used them, commands,
// and hashes of the state by which a second run is compared with the first. docs/record.md describes the datasets.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/exchange/spsc_ring.h"
#include "common/message/messages.h"
#include "common/record/hdf5_file.h"
#include "common/scene/scene_source.h"
#include "physics_node/world.h"

namespace palpate::physics {

inline constexpr std::int64_t frames_between_hashes = 20;
inline constexpr std::uint64_t most_kept_bytes = std::uint64_t{512}
                                                 << 20;  // of the files of a scene, together
inline constexpr std::uint64_t index_width = 7,
                               state_width = 25;  // columns of /session/inputs/NAME/index and state
// Of a hand whose motion presses tissue: columns of motion (sample, samples before it that are new) and of spring.
inline constexpr std::uint64_t motion_width = 2, spring_width = 3;

class SessionLog {
 public:
  /// Makes the datasets. @throws std::runtime_error or InputError: cannot be written, a file of the scene cannot be read
  SessionLog(const World& world, const SceneSource& source, Hdf5File& file);

  // By the thread that runs the frames; they allocate nothing.

  /// True if the entries of a frame have room; what comes without room is lost, and the record ends there.
  bool has_room() const noexcept;
  /// After each frame.
  /// @param hands  what the frame got
  void frame(const World& world, std::span<const std::optional<ToolState>> hands) noexcept;
  /// Before the frame from which on it acts.
  void command(const World& world, const Command& command) noexcept;
  void status(const NodeStatus& status) noexcept;
  /// After the last frame: the hash of the final state.
  void end(const World& world) noexcept;

  // By the thread that writes.

  /// Appends all that has come. @throws std::runtime_error
  void write();
  /// Flushes the file, then says in it how far it is complete. @throws std::runtime_error
  void flush();

 private:
  struct Entry {
    enum class Kind : std::uint32_t { input, hash, breaks, command, status, done } kind = Kind::done;
    std::uint32_t tool = 0;
    std::uint64_t frame = 0;  // frames done before this entry
    bool fresh = false;
    ToolState state;
    std::array<std::uint64_t, 2> counts{};
    std::array<double, 6> numbers{};
    std::array<std::uint8_t, 64> name{};
  };
  static constexpr std::size_t n_entries = 16384;

  /// Rows of one dataset that wait to be appended together.
  template <class T>
  struct Rows {
    std::string path;
    std::uint64_t width = 1;
    std::vector<T> values{};
  };

  void keep_source(const SceneSource& source);
  template <class T>
  Rows<T> make_rows(const std::string& path, std::uint64_t width);
  template <class T>
  void append(Rows<T>& rows);
  void note_hash(const World& world, std::uint64_t frames) noexcept;
  void push(const Entry& entry) noexcept;
  void take(const Entry& entry);

  Hdf5File& file_;
  std::unique_ptr<SpscRing<Entry, n_entries>> entries_;
  bool lost_ = false;                       // an entry found no room: nothing is logged any more
  std::vector<std::optional<Entry>> told_;  // newest input of each tool
  std::vector<std::uint64_t> played_;       // of each tool: the newest sample of its hand
  std::int64_t broken_ = 0, restored_ = 0;

  // the writer's
  std::vector<Rows<std::uint64_t>> input_index_;  // of each tool
  std::vector<Rows<double>> input_state_;
  std::vector<std::optional<Rows<std::uint64_t>>> motion_;  // of each tool that motion presses
  std::vector<Rows<double>> spring_;                        // of each tool
  std::vector<Rows<float>> samples_;                        // the same, new ones only, oldest last
  Rows<std::uint64_t> hashes_, breaks_, commands_, flushed_;
  Rows<double> command_values_, status_;
  Rows<std::uint8_t> command_names_;
  std::uint64_t complete_ = 0;  // frames of which all entries have been appended
};

}  // namespace palpate::physics
