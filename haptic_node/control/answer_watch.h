#pragma once
// Which answers of physics may be believed, and for how long.

#include <cstdint>

#include "common/message/messages.h"

namespace palpate::haptic {

/// A patch that keeps every promise of messages.h and lies within reach: all numbers finite, normals unit within
/// 1e-3, stiffness in (0, rigid_stiffness], damping not below zero, nothing farther than 1 km. Otherwise it is
/// rejected whole.
bool is_sound(const ContactPatch& patch, std::uint32_t tool) noexcept;
/// A wrench likewise: attitude unit within 1e-3, normal unit or zero, nothing above 1e6 N or 1e9 N/m.
bool is_sound(const ToolWrench& wrench, std::uint32_t tool) noexcept;

/// Of ContactPatch or ToolWrench. Times are the local clock's, never the sender's.
template <class Answer>
class AnswerWatch {
 public:
  explicit AnswerWatch(std::uint32_t tool) noexcept : tool_(tool) {}

  /// Looks at the newest answer, which may be the one seen before, or null.
  /// @return true if it is sound and newer than the last. After a silence any other tick counts as newer: the sender
  ///         has begun again. A tick farther ahead than physics can have come is rejected: those that follow would be older.
  bool accept(const Answer* answer, std::int64_t now_ns) noexcept;

  /// Somebody else answers from now on: whatever tick he gives next is newer.
  void listen_anew() noexcept { anew_ = true; }
  static constexpr std::uint64_t most_ahead = 10'000;  // frames within any patience, at 50 kHz

  bool ever() const noexcept { return ever_; }
  /// Measured time between answers [s], smoothed: slower ones are believed sooner than faster ones. Begins at 50 ms.
  double period() const noexcept { return period_; }
  /// Silence after which forces fade: three periods, within 120 to 200 ms [s]. Planes that stand still give no energy, so that
  /// a network that holds up everything for 100 ms is not felt.
  double patience() const noexcept;
  static constexpr double fade_time = 0.2;  // from full force to none [s]

  /// What silence leaves of the force: 1, then 1 - s^2 over the fade, s in [0, 1], to exactly 0. It begins gently, since
  /// most silences are three lost answers and end at once; a linear start was felt as a swing of 0.3 mm.
  double gain(std::int64_t now_ns) const noexcept;

  /// Since the newest patch was accepted [s]; large before the first.
  double silence(std::int64_t now_ns) const noexcept;

  std::uint64_t taken() const noexcept { return taken_; }
  std::uint64_t rejected() const noexcept { return rejected_; }

 private:
  std::uint32_t tool_;
  bool ever_ = false;
  bool anew_ = false;
  std::uint64_t tick_ = 0;       // of the last accepted answer
  std::uint64_t seen_tick_ = 0;  // of the last one looked at, so that a bad one is counted once
  bool seen_ = false;
  std::int64_t accepted_ns_ = 0;
  double period_ = 0.05;
  std::uint64_t taken_ = 0;
  std::uint64_t rejected_ = 0;
};

using PatchWatch = AnswerWatch<ContactPatch>;
using WrenchWatch = AnswerWatch<ToolWrench>;

}  // namespace palpate::haptic
