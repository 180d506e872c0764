#pragma once
// Forces with moments, and motions with turns, as one vector of six.

#include <Eigen/Core>

namespace palpate {

using Vec6 = Eigen::Matrix<double, 6, 1>;  // force [N] and moment [N m], or way [m] and turn [rad]
using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace palpate
