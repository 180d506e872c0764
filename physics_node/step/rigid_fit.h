#pragma once
// How far a shape is from another, wherever the two are.

#include <Eigen/Core>
#include <cmath>

namespace palpate::physics {

/// The best rotation and translation of a set of points onto another, from pairs as they come.
/// Source: Kabsch 1976; Umeyama 1991 for the sign.
class RigidFit {
 public:
  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) noexcept;
  /// After all were added.
  void solve() noexcept;
  Eigen::Vector3d operator()(const Eigen::Vector3d& from) const noexcept {
    return to_ + rotation_ * (from - from_);
  }
  double count() const noexcept { return n_; }

 private:
  double n_ = 0;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), to_ = from_;        // the first, then the middle [m]
  Eigen::Vector3d from_sum_ = Eigen::Vector3d::Zero(), to_sum_ = to_;  // against the first
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero(), rotation_ = products_;
};

/// Root mean square distance between two sets of points after that fit [m]. Takes no memory.
/// @param each_pair  each_pair(visit) calls visit(from, to) for each, twice in the same order
template <class EachPair>
double rigid_fit_rms(const EachPair& each_pair) {
  RigidFit fit;
  each_pair([&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) { fit.add(from, to); });
  if (fit.count() == 0) return 0;
  fit.solve();
  double sum = 0;
  each_pair(
      [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) { sum += (fit(from) - to).squaredNorm(); });
  return std::sqrt(sum / fit.count());
}

}  // namespace palpate::physics
