#pragma once
// Everything that the haptic node says and hears. Three threads, one job each, so that a slow reliable reader never
// holds up the newest tool state.

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/message/messages.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class Wire {
 public:
  /// @throws as Participant does
  Wire(const Membership& membership, std::vector<std::unique_ptr<ToolChannel>>& channels);
  ~Wire() { finish(); }

  void start();
  /// Sends what is left of the traces and ends the threads. Safe to repeat.
  void finish();

  /// A stop command has come.
  bool stop_commanded() const noexcept { return stop_commanded_.load(); }

  /// For what the slow thread wants to know of others.
  Participant& participant() noexcept { return participant_; }

  /// Of the slow thread that calls them: status out, patches in so far.
  bool write_status(const NodeStatus& status) noexcept { return status_.write(status); }
  struct HeardCounts {
    ReaderCounts patches, wrenches;
  };
  HeardCounts heard() const noexcept;
  ReaderCounts commands_heard() const noexcept;
  /// What there is to say about who speaks; each line once.
  std::vector<std::string> remarks();
  bool feels_wrenches() const noexcept { return wrenches_ != nullptr; }
  std::uint64_t trace_lost() const noexcept;
  const Participant& participant() const noexcept { return participant_; }
  const Writer<ToolState>& states() const noexcept { return states_; }
  const Writer<HapticTrace>& traces() const noexcept { return traces_; }
  const Writer<NodeStatus>& status() const noexcept { return status_; }

 private:
  struct Batch {
    HapticTrace trace{};
    int refusals = 0;
  };

  void receive() noexcept;
  void follow_physics() noexcept;
  void count_gap(const ContactPatch& patch) noexcept;
  void publish() noexcept;
  void trace_and_listen() noexcept;
  void drain(std::uint32_t tool, bool all) noexcept;
  void listen() noexcept;

  std::vector<std::unique_ptr<ToolChannel>>& channels_;
  Participant participant_;
  // As long as a hand is patient at most: after that the next physics may speak.
  static constexpr std::chrono::milliseconds physics_silence{200};
  Speaker physics_;
  Speaker people_;
  Reader<ContactPatch> patches_;
  std::unique_ptr<Reader<ToolWrench>> wrenches_;  // null: no tool feels them
  Reader<Command> commands_;
  Writer<ToolState> states_;
  Writer<HapticTrace> traces_;
  Writer<NodeStatus> status_;
  std::vector<Batch> batches_;
  std::vector<std::uint64_t> last_patch_;  // tick, by tool; the receive thread's
  std::uint64_t patches_lost_ = 0;         // the receive thread's
  std::vector<std::thread> threads_;
  std::atomic<bool> end_{false};
  std::atomic<bool> stop_commanded_{false};
  std::atomic<std::uint64_t> trace_refused_{0};  // samples
  mutable TripleBuffer<HeardCounts> counts_;
  mutable TripleBuffer<ReaderCounts> command_counts_;
};

}  // namespace palpate::haptic
