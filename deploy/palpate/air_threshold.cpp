#include "deploy/palpate/air_threshold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/record/volume.h"

namespace palpate::deploy {
namespace {

constexpr std::size_t n_bins = 512;  // Why: of CT then 2.6 HU wide
constexpr double wide_bins = 64;     // in which hills are looked for
constexpr std::size_t most_sorted = 200'000;
constexpr std::size_t most_labels = 8;  // Why: noise has more values, a map of labels none in between
constexpr std::size_t most_sampled = 4'000'000;
constexpr double outliers = 1e-4;  // at either end, of the cells. Why: hot cells would stretch the bins
constexpr double ct_padding = -1024, ct_dense = 300;  // [HU]
// Why: of one broad hump it is 0.9 and more, of air beside tissue half at the most.
constexpr double valley_to_peak = 0.6;

struct Histogram {
  double lo = 0, hi = 0;
  std::array<double, n_bins> count{};
  double above_lo(std::size_t bin) const {
    return (hi - lo) * (static_cast<double>(bin) + 0.5) / static_cast<double>(n_bins);
  }
};

std::vector<float> sampled(const std::vector<float>& intensity) {
  std::vector<float> some;
  const std::size_t stride = 1 + intensity.size() / most_sampled;
  for (std::size_t n = 0; n < intensity.size(); n += stride) some.push_back(intensity[n]);
  return some;
}

double quantile(std::vector<float>& values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(n)]);
}

/// What is outside of it counts at its ends.
Histogram histogram_of(const std::vector<float>& values, double lo, double hi) {
  Histogram histogram{lo, hi, {}};
  for (const float value : values) {
    const double bin = (static_cast<double>(value) - lo) / (hi - lo) * static_cast<double>(n_bins);
    histogram.count[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(n_bins - 1)))] += 1;
  }
  return histogram;
}

/// Sums over bins [0, n): how many, and of their intensities above lo.
struct Sums {
  std::array<double, n_bins + 1> count{}, intensity{};
  explicit Sums(const Histogram& histogram) {
    for (std::size_t n = 0; n < n_bins; ++n) {
      count[n + 1] = count[n] + histogram.count[n];
      intensity[n + 1] = intensity[n] + histogram.count[n] * histogram.above_lo(n);
    }
  }
  /// What bins [from, to) add to the variance between classes, but for a constant.
  double between(std::size_t from, std::size_t to) const {
    const double n = count[to] - count[from], sum = intensity[to] - intensity[from];
    return n > 0 ? sum * sum / n : 0;
  }
  double mean(std::size_t from, std::size_t to) const {
    return (intensity[to] - intensity[from]) / (count[to] - count[from]);
  }
};

/// Ends of the darkest class and of the one above it.
struct Ends {
  std::size_t air = 0, tissue = 0;
};
Ends best_ends(const Sums& sums, bool two_classes) {
  Ends best;
  double most = -1;
  for (std::size_t a = 1; a < n_bins; ++a) {
    if (sums.count[a] <= 0 || sums.count[n_bins] - sums.count[a] <= 0) continue;
    for (std::size_t b = two_classes ? n_bins : a + 1; b <= n_bins; ++b) {
      if (sums.count[b] - sums.count[a] <= 0) continue;
      const double variance = sums.between(0, a) + sums.between(a, b) + sums.between(b, n_bins);
      if (variance > most * (1 + 1e-12)) most = variance, best = {a, b};
    }
  }
  return best;
}

struct Levels {
  std::size_t n = 1;                                       // different values
  double apart = std::numeric_limits<double>::infinity();  // at the least: 1 of whole numbers
};
Levels levels_of(const std::vector<float>& values) {
  std::vector<float> some;
  const std::size_t stride = 1 + values.size() / most_sorted;
  for (std::size_t n = 0; n < values.size(); n += stride) some.push_back(values[n]);
  std::sort(some.begin(), some.end());
  Levels levels;
  for (std::size_t n = 1; n < some.size(); ++n) {
    if (some[n] <= some[n - 1]) continue;
    ++levels.n;
    levels.apart = std::min(levels.apart, static_cast<double>(some[n]) - static_cast<double>(some[n - 1]));
  }
  return levels;
}

/// Values in so wide bins that a valley is none of chance, and each as many levels wide, so that none has more for
/// that.
class Hills {
 public:
  Hills(const std::vector<float>& values, double lo, double hi) : lo_(lo), hi_(hi) {
    const Levels levels = levels_of(values);
    labels_ = levels.n <= most_labels;
    const double level = std::min(levels.apart, hi - lo);
    width_ = level * std::max(1.0, std::ceil((hi - lo) / (level * wide_bins)));
    count_.resize(1 + bin_of(hi), 0);
    for (const float value : values) count_[bin_of(static_cast<double>(value))] += 1;
  }
  /// Are there less at an intensity than at the highest peaks on both sides of it?
  bool has_valley_at(double intensity) const {
    if (labels_) return true;
    const auto at = count_.begin() + static_cast<std::ptrdiff_t>(bin_of(intensity));
    if (at == count_.begin()) return false;
    return *at <= valley_to_peak *
                      std::min(*std::max_element(count_.begin(), at), *std::max_element(at, count_.end()));
  }

 private:
  std::size_t bin_of(double value) const {
    return static_cast<std::size_t>((std::clamp(value, lo_, hi_) - lo_) / width_);
  }
  double lo_, hi_, width_ = 0;
  bool labels_ = false;
  std::vector<double> count_;
};

/// Means of the darkest class and of the one above it.
struct Means {
  double air = 0, tissue = 0;
  double middle() const { return 0.5 * (air + tissue); }
};
std::optional<Means> classes_of(const Histogram& histogram, bool two_classes) {
  const Sums sums(histogram);
  const Ends ends = best_ends(sums, two_classes);
  if (ends.air == 0) return std::nullopt;
  return Means{histogram.lo + sums.mean(0, ends.air), histogram.lo + sums.mean(ends.air, ends.tissue)};
}

/// Whose middle lies in a valley of the histogram.
std::optional<Means> air_and_tissue(const std::vector<float>& values, const Histogram& histogram,
                                    bool two_classes) {
  auto means = classes_of(histogram, two_classes);
  if (!means) return std::nullopt;
  if (const auto dim = classes_of(histogram_of(values, histogram.lo, means->tissue), true)) means = dim;
  return Hills(values, histogram.lo, histogram.hi).has_valley_at(means->middle()) ? means : std::nullopt;
}

}  // namespace

std::optional<AirThreshold> air_threshold(const std::vector<float>& intensity) {
  if (intensity.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(intensity.begin(), intensity.end());
  AirThreshold found;
  found.lowest = static_cast<double>(*least), found.highest = static_cast<double>(*most);
  if (!(found.lowest < found.highest)) return std::nullopt;
  const bool is_ct = looks_like_ct(found.lowest, found.highest);
  std::vector<float> values = sampled(intensity);
  double lo = is_ct ? std::max(ct_padding, found.lowest) : quantile(values, outliers);
  double hi = is_ct ? std::min(ct_dense, found.highest) : quantile(values, 1 - outliers);
  if (!(lo < hi)) lo = found.lowest, hi = found.highest;
  const Histogram histogram = histogram_of(values, lo, hi);
  auto means = is_ct ? std::nullopt : air_and_tissue(values, histogram, false);
  if (!means) means = air_and_tissue(values, histogram, true);
  if (!means) return std::nullopt;
  found.air = means->air, found.tissue = means->tissue;
  found.intensity = means->middle();
  return found;
}

}  // namespace palpate::deploy
