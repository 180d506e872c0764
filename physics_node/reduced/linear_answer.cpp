#include "physics_node/reduced/linear_answer.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr int most_cycles = 200;

}  // namespace

LinearAnswer::LinearAnswer(const Body& body, double shift, const Crew& crew)
    : hierarchy_(body),
      gradients_(hierarchy_),
      shift_(shift),
      mass_(Eigen::VectorXd::Zero(3 * hierarchy_.fine().n_nodes())),
      row_of_(static_cast<std::size_t>(body.capacity()), -1) {
  hierarchy_.set_step(1 / std::sqrt(shift));
  hierarchy_.linearise(crew, 1);
  bool held = false;
  for (Eigen::Index row = 0; row < n_rows(); ++row) {
    const Index node = hierarchy_.storage()[static_cast<std::size_t>(row)];
    if (node < 0) continue;
    row_of_[static_cast<std::size_t>(node)] = row;
    if (body.inverse_mass[static_cast<std::size_t>(node)] > 0)
      mass_.segment<3>(3 * row).setConstant(node_mass(body, node));
    else
      held = true;
  }
  if (held)
    rigid_.resize(3 * n_rows(), 0);
  else
    find_rigid(body);
}

/// Along and about the axes, each less what it has of those before it (Gram and Schmidt).
void LinearAnswer::find_rigid(const Body& body) {
  rigid_ = Eigen::MatrixXd::Zero(3 * n_rows(), 6);
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index row = 0; row < n_rows(); ++row)
    if (mass_[3 * row] > 0)
      moment += mass_[3 * row] * body.rest_position(hierarchy_.storage()[static_cast<std::size_t>(row)]);
  const Vec3 centre = 3 * moment / mass_.sum();
  for (Eigen::Index row = 0; row < n_rows(); ++row) {
    if (!(mass_[3 * row] > 0)) continue;
    const Vec3 arm = body.rest_position(hierarchy_.storage()[static_cast<std::size_t>(row)]) - centre;
    for (Eigen::Index a = 0; a < 3; ++a) {
      rigid_.block<3, 1>(3 * row, a) = Vec3::Unit(a);
      rigid_.block<3, 1>(3 * row, 3 + a) = Vec3::Unit(a).cross(arm);
    }
  }
  const auto product = [&](Eigen::Index i, Eigen::Index j) {
    return rigid_.col(i).dot(mass_.cwiseProduct(rigid_.col(j)));
  };
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) rigid_.col(i) -= product(i, j) * rigid_.col(j);
    rigid_.col(i) /= std::sqrt(product(i, i));
  }
}

bool LinearAnswer::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance,
                         const Crew& crew) noexcept {
  // A scale of its own: forces of small weights would be denormal in single precision.
  const double scale = b.lpNorm<Eigen::Infinity>();
  x.setZero();
  if (!(scale > 0)) return scale == 0;
  for (Eigen::Index row = 0; row < n_rows(); ++row)
    for (Eigen::Index a = 0; a < 3; ++a)
      gradients_.b[static_cast<std::size_t>(a)][static_cast<std::size_t>(row)] =
          mass_[3 * row] > 0 ? static_cast<float>(b[3 * row + a] / scale) : 0.0F;
  const GradientReport report = gradients_.solve(hierarchy_, crew, tolerance, most_cycles);
  for (Eigen::Index row = 0; row < n_rows(); ++row)
    for (Eigen::Index a = 0; a < 3; ++a)
      if (mass_[3 * row] > 0)
        x[3 * row + a] =
            scale *
            static_cast<double>(gradients_.x[static_cast<std::size_t>(a)][static_cast<std::size_t>(row)]);
  return report.converged;
}

}  // namespace palpate::physics
