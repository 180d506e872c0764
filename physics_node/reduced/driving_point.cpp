#include "physics_node/reduced/driving_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <complex>

namespace palpate::physics {
namespace {

/// The nearest that is symmetric and takes no energy out of nothing.
Eigen::Matrix3d not_below_zero(const Eigen::Matrix3d& S) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> own(0.5 * (S + S.transpose()));
  return own.eigenvectors() * own.eigenvalues().cwiseMax(0).asDiagonal() * own.eigenvectors().transpose();
}

}  // namespace

Eigen::Matrix3cd DrivingPoint::compliance(const VibrationModes& modes, double beta, double w) const {
  using Complex = std::complex<double>;
  const Eigen::Matrix3d K = residual - shift * residual_inertia;
  const Eigen::Matrix3cd impedance =
      K.cast<Complex>() * Complex(1, w * beta) - (w * w * residual_inertia).cast<Complex>();
  const Eigen::Matrix3cd S = residual.cast<Complex>();
  Eigen::Matrix3cd sum = residual.isZero() ? S : Eigen::Matrix3cd(S * impedance.fullPivLu().solve(S));
  for (Eigen::Index i = 0; i < modes.omega2.size(); ++i) {
    const std::complex<double> stiffness(modes.omega2[i] - w * w, w * beta * modes.omega2[i]);
    sum += (psi.col(i) * psi.col(i).transpose()).cast<std::complex<double>>() / stiffness;
  }
  return sum;
}

DrivingPoint driving_point(LinearAnswer& body, const VibrationModes& modes,
                           std::span<const ContactShare> contact, const Crew& crew) {
  const Eigen::Index n = 3 * body.n_rows();
  Eigen::VectorXd mass(n);
  for (Eigen::Index row = 0; row < body.n_rows(); ++row)
    mass.segment<3>(3 * row).setConstant(body.mass()[row]);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, 3), x(n, 3);
  for (const ContactShare& part : contact)
    if (const Eigen::Index row = body.row_of(part.node); row >= 0 && body.mass()[row] > 0)
      b.middleRows<3>(3 * row) += part.share * Eigen::Matrix3d::Identity();
  DrivingPoint point{.psi = b.transpose() * modes.shape, .shift = body.shift(), .converged = true};
  // Without what drives the modes the answer is that of all others. Taken off afterwards it would be lost in the digits of theirs.
  const Eigen::MatrixXd rest = b - mass.asDiagonal() * (modes.shape * point.psi.transpose());
  Eigen::VectorXd answer(n);
  for (Eigen::Index a = 0; a < 3; ++a) {
    point.converged = body.solve(rest.col(a), answer, LinearAnswer::fine, crew) && point.converged;
    x.col(a) = answer;
  }
  x -= modes.shape * (modes.shape.transpose() * (mass.asDiagonal() * x)).eval();
  point.residual = not_below_zero(b.transpose() * x);
  point.residual_inertia = not_below_zero(x.transpose() * (mass.asDiagonal() * x));
  return point;
}

}  // namespace palpate::physics
