#pragma once
// Who of a session's nodes can be heard, as any node hears the others: by their messages.

#include <cstdint>
#include <string>

#include "common/wire/participant.h"
#include "common/wire/reader.h"

namespace palpate::test {

class SessionEar {
 public:
  explicit SessionEar(int domain) : participant_(domain) {}

  /// Takes what has come; every few milliseconds.
  void listen();

  /// Physics answers a tick that the hand made at or after that time: each of the two has heard the other's new self.
  bool answered_since(std::int64_t t_ns) const { return patch_.answers_ns >= t_ns; }
  /// This process has drawn more than so many pictures.
  bool draws(pid_t render, std::uint64_t more_than) const;
  std::uint64_t pictures(pid_t render) const;
  /// Of the hand's newest status: patches that it has taken, what it says of itself.
  const NodeStatus& hand() const { return hand_; }
  const NodeStatus& eye() const { return eye_; }
  std::uint64_t hand_statuses() const { return hand_statuses_; }  // heard so far

  /// Samples of the hand's traces that did not come though the process that makes them lived.
  std::uint64_t trace_gaps() const { return trace_gaps_; }
  std::uint64_t trace_samples() const { return trace_samples_; }
  /// The hand's process is a new one, or will be: its ticks begin anew.
  void expect_new_traces() { last_trace_tick_ = 0; }

 private:
  void take(const HapticTrace& trace);

  Participant participant_;
  Reader<ContactPatch> patches_{participant_};
  Reader<NodeStatus> statuses_{participant_};
  Reader<HapticTrace> traces_{participant_};
  ContactPatch patch_;
  NodeStatus hand_, eye_;
  HapticTrace trace_;
  std::uint64_t hand_statuses_ = 0;
  std::uint64_t last_trace_tick_ = 0, trace_gaps_ = 0, trace_samples_ = 0;
};

}  // namespace palpate::test
