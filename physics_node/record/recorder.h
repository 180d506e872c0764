#pragma once
// Leaves a run behind: a CSV per tool, energy.csv, and record.h5 with positions, tools and all that is needed to run it
// again. Killed at any moment, it leaves files that are whole up to one second ago. frame() only copies what is due into
// buffers taken at the start; a thread of its own writes the files.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/exchange/spsc_ring.h"
#include "common/record/hdf5_file.h"
#include "common/scene/record_spec.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/record/session_log.h"
#include "physics_node/world.h"

namespace palpate::physics {

class Recorder {
 public:
  enum class WhenBehind { drop, wait };  // a live run drops and counts; simulated time waits

  /// @param source  what the scene was read from
  /// @param folder  must exist; tool_NAME.csv, energy.csv and record.h5 are made in it
  /// @throws InputError or std::runtime_error where files cannot be made
  Recorder(const World& world, const SceneSource& source, const std::string& folder, WhenBehind when_behind);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // These allocate nothing.

  /// After every frame.
  /// @param hands  what the frame got
  void frame(const World& world, std::span<const std::optional<ToolState>> hands) noexcept;
  /// Before the frame from which on it acts.
  void command(const World& world, const Command& command) noexcept { session_->command(world, command); }
  void status(const NodeStatus& status) noexcept { session_->status(status); }
  /// From the next frame on.
  void set_when_behind(WhenBehind when_behind) noexcept { when_behind_ = when_behind; }
  /// The disk took no more: what came since is lost, and finish() will say so.
  bool failed() const noexcept { return failed_; }

  /// Takes the positions at the end, writes what is left and closes the files. @throws std::runtime_error: disk full
  void finish(const World& world);

  /// CSV of a tool, relative to the folder.
  static std::string trace_name(const std::string& tool);
  std::uint64_t dropped() const { return dropped_; }
  double force_peak(std::size_t tool) const { return tallies_[tool].peak; }
  double force_rms(std::size_t tool) const;
  double moment_peak(std::size_t tool) const { return tallies_[tool].moment_peak; }
  std::uint32_t contacts_max(std::size_t tool) const { return tallies_[tool].contacts_max; }

 private:
  struct ToolRow {
    std::uint32_t tool = 0;
    std::uint32_t contacts = 0;
    double t = 0;
    Array3 p{}, force{}, moment{};  // force and moment low-passed
    Array3 raw_force{}, raw_moment{};
  };
  struct EnergyRow {
    double t = 0;
    EnergyLedger ledger;
  };
  struct Tally {
    double peak = 0, moment_peak = 0, squares = 0;
    std::uint64_t rows = 0;
    std::uint32_t contacts_max = 0;
  };
  struct Snapshot {
    std::atomic<bool> full{false};
    double t = 0;
    std::vector<std::vector<float>> position;      // per body (n_masses x 3)
    std::vector<std::vector<std::uint8_t>> flags;  // per body (n_masses)
    // Of the bodies that may yield; else EMPTY:
    std::vector<std::vector<std::uint8_t>> yielded;  // yielded share, 255: all (n_masses)
    std::vector<std::vector<Mask>> live;             // live elements (n_masses)
  };
  static constexpr std::size_t n_snapshots = 8;

  void make_files(const World& world, const SceneSource& source);
  std::FILE* make_csv(const std::string& name, const char* heading);
  void note_tools(const World& world) noexcept;
  void note_energy(const World& world) noexcept;
  void note_positions(const World& world) noexcept;
  void note_end(const World& world) noexcept;
  void take_snapshot(const World& world, Snapshot& snapshot) noexcept;
  /// Is it time for the next of what comes rate_Hz times a second? Counts it if so.
  bool is_due(const World& world, std::int64_t& n) const noexcept;
  /// Waits a little for the thread that writes, if it may. @return false if it may not
  bool wait() const noexcept;
  void write_rows();
  void write_energy();
  void write_snapshots();
  void flush();
  void work() noexcept;

  std::string folder_;
  WhenBehind when_behind_;
  RecordSpec spec_;
  std::vector<std::string> tool_names_;
  std::vector<std::string> body_names_;
  std::vector<Tally> tallies_;
  std::vector<std::FILE*> csv_;         // of the tools, then of the energy
  std::vector<std::string> csv_names_;  // their paths
  std::FILE* energy_csv_ = nullptr;     // one of csv_
  std::unique_ptr<Hdf5File> hdf5_;
  std::unique_ptr<SessionLog> session_;
  std::unique_ptr<SpscRing<ToolRow, 16384>> rows_;
  std::unique_ptr<SpscRing<EnergyRow, 1024>> energy_rows_;
  std::vector<std::unique_ptr<Snapshot>> snapshots_;
  std::vector<std::vector<Condition>> conditions_;  // by body, of its masses; only while there are snapshots
  std::size_t next_snapshot_ = 0;                   // frame()'s
  std::size_t next_written_ = 0;                    // the thread's
  std::int64_t snapshots_due_ = 0;
  double snapshot_t_ = -1;  // of the newest one [s]; below 0: none
  std::int64_t energies_due_ = 0;
  std::uint64_t dropped_ = 0;
  std::atomic<bool> stop_{false};
  std::atomic<bool> failed_{false};
  std::string failure_;
  std::thread thread_;
  bool finished_ = false;
};

}  // namespace palpate::physics
