#include "physics_node/reduced/driving_point.h"

#include <Eigen/Eigenvalues>
#include <complex>

namespace palpate::physics {
namespace {

constexpr double no_answer =
    1e-6;  // of the inertia of answers: a direction whose answer is that of others, or none

/// Of the answers x to forces b the directions that there are, M-orthonormal; then the best in them.
void add_modes(const Eigen::MatrixXd& b, const Eigen::MatrixXd& x, const Eigen::VectorXd& mass, double shift,
               DrivingPoint& point) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> inertia(x.transpose() * (mass.asDiagonal() * x));
  const double most = inertia.eigenvalues().maxCoeff();
  const auto n = most > 0 ? (inertia.eigenvalues().array() > no_answer * most).count() : 0;
  point.added.resize(x.rows(), n);
  if (n == 0) return;
  const Eigen::MatrixXd whiten = inertia.eigenvectors().rightCols(n) *
                                 inertia.eigenvalues().tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::Matrix3d stiff = b.transpose() * x;  // x^T (K + s M) x
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(whiten.transpose() *
                                                            (0.5 * (stiff + stiff.transpose())) * whiten);
  point.added = x * (whiten * ritz.eigenvectors());
  point.omega2 = ritz.eigenvalues().array() - shift;
}

}  // namespace

Eigen::Matrix3cd DrivingPoint::compliance(double beta, double w) const {
  Eigen::Matrix3cd sum = Eigen::Matrix3cd::Zero();
  for (Eigen::Index i = 0; i < omega2.size(); ++i) {
    const std::complex<double> stiffness(omega2[i] - w * w, w * beta * omega2[i]);
    sum += (psi.col(i) * psi.col(i).transpose()).cast<std::complex<double>>() / stiffness;
  }
  return sum;
}

DrivingPoint driving_point(LinearAnswer& body, const VibrationModes& modes,
                           std::span<const MassShare> contact, const Crew& crew) {
  const Eigen::VectorXd& mass = body.mass();
  const Eigen::Index rows = mass.size(), n = modes.omega2.size();
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(rows, 3), x(rows, 3);
  for (const MassShare& part : contact)
    if (const Eigen::Index row = body.row_of(part.cell); row >= 0 && mass[3 * row] > 0)
      b.middleRows<3>(3 * row) += part.share * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3Xd psi = b.transpose() * modes.shape;
  // Without what drives the modes the answer is that of all others. Taken off afterwards it would be lost in the digits of theirs.
  const Eigen::MatrixXd rest = b - mass.asDiagonal() * (modes.shape * psi.transpose());
  DrivingPoint point;
  point.converged = true;
  Eigen::VectorXd answer(rows);
  for (Eigen::Index a = 0; a < 3; ++a) {
    point.converged = body.solve(rest.col(a), answer, LinearAnswer::fine, crew) && point.converged;
    x.col(a) = answer;
  }
  x -= modes.shape * (modes.shape.transpose() * (mass.asDiagonal() * x)).eval();
  add_modes(rest, x, mass, body.shift(), point);
  const Eigen::Index added = point.added.cols();
  Eigen::VectorXd omega2(n + added);
  omega2 << modes.omega2, point.omega2;
  point.omega2 = std::move(omega2);
  point.psi.resize(3, n + added);
  point.psi << psi, b.transpose() * point.added;
  return point;
}

}  // namespace palpate::physics
