#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/record/volume.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

/// A row of n cells becomes a row of m cells over the same length. Both rules are linear in x along one axis, so three
/// axes in turn give trilinear interpolation, or the average over a box.
class RowRule {
 public:
  RowRule(int n, int m)
      : n_(n), m_(m), ratio_(static_cast<double>(n) / m), slope_(static_cast<std::size_t>(n)) {}

  void apply(const double* from, double* to) {
    if (m_ >= n_) {
      interpolate(from, to);
    } else {
      average(from, to);
    }
  }

 private:
  /// Between the two nearest centres; beyond the outermost centres, the outermost value.
  void interpolate(const double* from, double* to) const {
    for (int j = 0; j < m_; ++j) {
      const double x = std::clamp((j + 0.5) * ratio_ - 0.5, 0.0, n_ - 1.0);
      const int i = std::min(static_cast<int>(x), std::max(0, n_ - 2));
      const double t = x - i;
      to[j] = n_ == 1 ? from[0] : from[i] + t * (from[i + 1] - from[i]);
    }
  }

  /// The mean over a new cell of what the old cells hold. Inside old cell i the value is taken as
  ///
  ///   v(x) = v_i + s_i (x - x_i),   s_i the smaller of the differences to its neighbours, 0 where they disagree
  ///
  /// whose mean over cell i is v_i whatever s_i is: the total is kept, ramps stay ramps, nothing overshoots.
  /// Source: van Leer 1979, piecewise linear reconstruction with the minmod limiter.
  void average(const double* from, double* to) {
    for (int i = 0; i < n_; ++i) slope_[static_cast<std::size_t>(i)] = limited_slope(from, i);
    for (int j = 0; j < m_; ++j) {
      const double lo = j * ratio_, hi = (j + 1) * ratio_;
      double sum = 0;
      for (int i = static_cast<int>(lo); i < n_ && i < hi; ++i) {
        const double a = std::max<double>(lo, i), b = std::min<double>(hi, i + 1);
        if (b > a)
          sum += (b - a) * (from[i] + slope_[static_cast<std::size_t>(i)] * (0.5 * (a + b) - (i + 0.5)));
      }
      to[j] = sum / ratio_;
    }
  }

  double limited_slope(const double* v, int i) const {
    if (n_ == 1) return 0;
    if (i == 0) return v[1] - v[0];
    if (i == n_ - 1) return v[i] - v[i - 1];
    const double left = v[i] - v[i - 1], right = v[i + 1] - v[i];
    if (left * right <= 0) return 0;
    return std::abs(left) < std::abs(right) ? left : right;
  }

  int n_, m_;
  double ratio_;  // length of a new cell in old ones
  std::vector<double> slope_;
};

/// Changes the number of cells along one axis.
void resample_axis(std::vector<float>& values, std::array<int, 3>& size, std::size_t axis, int m) {
  const auto n = static_cast<std::size_t>(size[axis]), n_new = static_cast<std::size_t>(m);
  if (n == n_new) return;
  std::size_t stride = 1, outer = 1;
  for (std::size_t a = 0; a < axis; ++a) stride *= static_cast<std::size_t>(size[a]);
  for (std::size_t a = axis + 1; a < 3; ++a) outer *= static_cast<std::size_t>(size[a]);
  std::vector<float> result(stride * outer * n_new);
  std::vector<double> from(n), to(n_new);
  RowRule rule(size[axis], m);
  for (std::size_t o = 0; o < outer; ++o) {
    for (std::size_t s = 0; s < stride; ++s) {
      for (std::size_t i = 0; i < n; ++i) from[i] = static_cast<double>(values[(o * n + i) * stride + s]);
      rule.apply(from.data(), to.data());
      for (std::size_t j = 0; j < n_new; ++j)
        result[(o * n_new + j) * stride + s] = static_cast<float>(to[j]);
    }
  }
  values = std::move(result);
  size[axis] = m;
}

}  // namespace

Volume resample(const Volume& volume, std::array<int, 3> partition) {
  check_size("partition", {partition[0], partition[1], partition[2]});
  Volume out = volume;
  // Coarser axes first: less to do on the others.
  for (const bool coarser : {true, false})
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((partition[axis] < volume.size[axis]) == coarser)
        resample_axis(out.intensity, out.size, axis, partition[axis]);
  for (int axis = 0; axis < 3; ++axis)
    out.spacing[axis] *= static_cast<double>(volume.size[static_cast<std::size_t>(axis)]) /
                         partition[static_cast<std::size_t>(axis)];
  // The corner stays where it was; the first centre is half a new cell from it.
  const Eigen::Vector3d shift = 0.5 * (out.spacing - volume.spacing);
  out.origin += volume.orientation ? Eigen::Vector3d(*volume.orientation * shift) : shift;
  return out;
}

}  // namespace palpate
