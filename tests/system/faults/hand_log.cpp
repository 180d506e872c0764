#include "tests/system/faults/hand_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/time/clock.h"

namespace palpate::test {
namespace {

constexpr std::size_t most_recent = 30'000;             // writes
constexpr std::int64_t device_lets_go_ns = 30'000'000;  // the watchdog of the simulated device

}  // namespace

void HandLog::read() {
  const std::uint64_t written = device_.writes.load();
  if (written - seen_ >= WatchedDevice::kept && trouble_.empty())
    trouble_ = "the test was too slow: writes to the device were missed";
  for (; seen_ < written; ++seen_) {
    judge(device_.at(seen_));
    recent_.push_back(device_.at(seen_));
    if (recent_.size() > most_recent) recent_.pop_front();
  }
}

/// A device without power, or silent for longer than its own watchdog, forces nothing: what comes then is a rise from none.
void HandLog::judge(const WatchedDevice::Write& now) {
  if (!(now.norm <= limit_ + 1e-9) && trouble_.empty())
    trouble_ = fmt::format("{} N written, the limit is {} N", now.norm, limit_);
  if (recent_.empty() || now.powered == 0) return;
  const WatchedDevice::Write& before = recent_.back();
  const bool let_go = before.powered == 0 || now.t_ns - before.t_ns > device_lets_go_ns;
  const double rise = now.norm - (let_go ? 0.0 : before.norm) - stiffness_ * std::abs(now.z - before.z);
  rise_ = std::max(rise_, rise);
  if (rise > slew + 1e-9 && trouble_.empty())
    trouble_ = fmt::format("a kick: from {:.3f} to {:.3f} N while the hand moved by {:.3f} mm in {:.2f} ms",
                           before.norm, now.norm, 1e3 * (now.z - before.z),
                           1e-6 * static_cast<double>(now.t_ns - before.t_ns));
}

std::int64_t HandLog::last_force(std::int64_t from_ns, std::int64_t to_ns) const {
  std::int64_t last_ns = from_ns;
  for (const auto& write : recent_)
    if (write.t_ns >= from_ns && write.t_ns < to_ns && write.norm > 0) last_ns = write.t_ns;
  return last_ns;
}

std::int64_t HandLog::next_force(std::int64_t from_ns) const {
  for (const auto& write : recent_)
    if (write.t_ns >= from_ns && write.norm > 0) return write.t_ns;
  return 0;
}

double HandLog::largest_between(std::int64_t from_ns, std::int64_t to_ns) const {
  double largest = 0;
  for (const auto& write : recent_)
    if (write.t_ns >= from_ns && write.t_ns < to_ns) largest = std::max(largest, write.norm);
  return largest;
}

std::optional<double> HandLog::felt_after(std::int64_t from_ns) const {
  for (const auto& write : recent_)
    if (write.t_ns >= from_ns) return std::abs(write.felt);
  return {};
}

double HandLog::take_largest_rise() { return std::exchange(rise_, 0.0); }

}  // namespace palpate::test
