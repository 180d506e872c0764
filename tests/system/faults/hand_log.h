#pragma once
// What a hand on the watched device was made to feel, write by write, and whether that kept the promises: no kick,
// nothing beyond the limit, nothing where there is no source.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "tests/support/devices/watched_device.h"

namespace palpate::test {

class HandLog {
 public:
  /// Most that the force may rise in a tick beyond what the hand's own motion makes [N].
  static constexpr double slew = 0.1;

  /// @param stiffness  of the hand spring [N/m]  @param limit  most force [N]
  HandLog(const WatchedDevice& device, double stiffness, double limit)
      : device_(device), stiffness_(stiffness), limit_(limit) {}

  /// Takes what was written since the last call; at least every minute, or writes are missed (and told).
  void read();

  double force() const { return recent_.empty() ? 0.0 : recent_.back().norm; }  // newest [N]
  /// The last write with a force in this span, which must lie in the last half minute; its begin if there was none.
  std::int64_t last_force(std::int64_t from_ns, std::int64_t to_ns) const;
  /// The first write with a force at or after that time; 0: none yet.
  std::int64_t next_force(std::int64_t from_ns) const;
  /// Largest force written in this span [N].
  double largest_between(std::int64_t from_ns, std::int64_t to_ns) const;
  /// What the hand felt, as the device has it, at the first sample after that time [N]; nothing: none yet.
  std::optional<double> felt_after(std::int64_t from_ns) const;

  /// Largest rise beyond the hand's own motion since the last call [N].
  double take_largest_rise();
  std::uint64_t writes() const { return seen_; }
  const std::string& trouble() const { return trouble_; }  // the first broken promise, in words; empty: none

 private:
  void judge(const WatchedDevice::Write& now);

  const WatchedDevice& device_;
  double stiffness_, limit_;
  std::uint64_t seen_ = 0;
  std::deque<WatchedDevice::Write> recent_;
  double rise_ = 0;
  std::string trouble_;
};

}  // namespace palpate::test
