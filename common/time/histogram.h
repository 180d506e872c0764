#pragma once
// Counts of measured durations in bins of equal width. Fixed size, so that it can be filled in a real-time tick
// and copied between threads.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpate {

/// `Bins` bins of `width` from zero upwards, and one for all that is above. The unit is the caller's.
template <std::size_t Bins>
class Histogram {
 public:
  explicit Histogram(double width = 1.0) noexcept : width_(width) {}

  /// Negative values count as zero; a value that is not a number is not counted.
  void add(double value) noexcept {
    if (std::isnan(value)) return;
    value = std::max(value, 0.0);
    const double bin = value / width_;
    counts_[bin < static_cast<double>(Bins) ? static_cast<std::size_t>(bin) : Bins] += 1;
    total_ += 1;
    sum_ += value;
    max_ = std::max(max_, value);
  }

  std::uint64_t total() const noexcept { return total_; }
  std::uint64_t overflow() const noexcept { return counts_[Bins]; }
  std::uint64_t count(std::size_t bin) const noexcept { return counts_[bin]; }
  double max() const noexcept { return max_; }
  double mean() const noexcept { return total_ == 0 ? 0.0 : sum_ / static_cast<double>(total_); }

  /// Upper edge of the bin in which the fraction `q` (0..1) of all values is reached, never above max();
  /// max() itself if that is beyond the last bin; 0 if nothing was counted.
  double percentile(double q) const noexcept {
    if (total_ == 0) return 0.0;
    const auto wanted = std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(total_))));
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < Bins; ++bin) {
      seen += counts_[bin];
      if (seen >= wanted) return std::min(width_ * static_cast<double>(bin + 1), max_);
    }
    return max_;
  }

 private:
  double width_;
  std::array<std::uint64_t, Bins + 1> counts_{};
  std::uint64_t total_ = 0;
  double sum_ = 0;
  double max_ = 0;
};

/// Bin of the coarse histogram in NodeStatus: bin b counts [2^b, 2^(b+1)) microseconds, bin 0 also 0.
inline std::size_t octave_bin(std::int64_t us, std::size_t bins) noexcept {
  if (us < 2) return 0;
  return std::min(bins - 1, static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(us)) - 1));
}

}  // namespace palpate
