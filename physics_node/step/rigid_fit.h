#pragma once
// How far a shape is from another, wherever the two are.

#include <Eigen/Core>

namespace palpate::physics {

/// Root mean square distance between two sets of points after the best rotation and translation of `from` onto `to`.
/// Source: Kabsch 1976, by way of Eigen::umeyama.
double rigid_fit_rms(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace palpate::physics
