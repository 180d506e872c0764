#include "physics_node/reduced/lowest_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpate::physics {
namespace {

constexpr int block = 4;
constexpr double nothing_new = 1e-4;  // of a vector: what is left of it beside the others is rounding

/// A number in [-1, 1) of a row, component and vector: the same on every machine (splitmix64).
double scattered(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9;
  n = (n ^ (n >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1p-52 - 1;
}

/// M-orthonormal vectors, and what (K + s M)^-1 M makes of them.
class Basis {
 public:
  Basis(LinearAnswer& body, int most)
      : body_(body), mass_(body.mass()), v_(mass_.size(), most), answer_(mass_.size(), most) {
    // What nothing resists is known, and answers by 1 / s.
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(body.rigid().cols(), most); ++i) {
      v_.col(size_++) = body.rigid().col(i);
      answer_.col(answered_++) = body.rigid().col(i) / body.shift();
    }
  }
  int size() const { return size_; }
  int answered() const { return answered_; }
  bool is_full() const { return size_ == v_.cols(); }
  auto answers() const { return answer_.leftCols(answered_); }
  auto vectors() const { return v_.leftCols(size_); }

  /// Adds what is new in x: twice, since once leaves rounding.
  void add(Eigen::VectorXd x) {
    const double before = norm(x);
    for (int pass = 0; pass < 2; ++pass)
      if (size_ > 0) x -= vectors() * (vectors().transpose() * mass_.cwiseProduct(x)).eval();
    const double left = norm(x);
    if (is_full() || !(left > nothing_new * before)) return;
    v_.col(size_++) = x / left;
  }
  void answer_next(const Crew& crew) {
    Eigen::VectorXd x(mass_.size());
    body_.solve(mass_.cwiseProduct(v_.col(answered_)), x, LinearAnswer::fine, crew);
    // Without that, what little an inexact answer has of a rigid motion would be larger than itself: s is far below omega^2.
    if (const Eigen::MatrixXd& rigid = body_.rigid(); rigid.cols() > 0)
      x -= rigid * (rigid.transpose() * mass_.cwiseProduct(x)).eval();
    answer_.col(answered_++) = x;
  }
  /// T = V^T M A, of those that are answered.
  Eigen::MatrixXd projected() const {
    const Eigen::MatrixXd T = v_.leftCols(answered_).transpose() * (mass_.asDiagonal() * answers());
    return 0.5 * (T + T.transpose());
  }
  double norm(const Eigen::VectorXd& x) const { return std::sqrt(x.dot(mass_.cwiseProduct(x))); }

 private:
  LinearAnswer& body_;
  const Eigen::VectorXd& mass_;
  Eigen::MatrixXd v_, answer_;
  int size_ = 0, answered_ = 0;
};

}  // namespace

VibrationModes lowest_modes(LinearAnswer& body, const ModeTask& task, const Crew& crew) {
  Basis basis(body, task.most_solves);
  for (int n = 0; n < block; ++n) {
    Eigen::VectorXd x(3 * body.n_rows());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] = body.mass()[i] > 0 ? scattered(static_cast<std::uint64_t>(block * i + n)) : 0;
    basis.add(std::move(x));
  }
  VibrationModes modes;
  while (basis.answered() < basis.size()) {
    const int end = basis.size();
    while (basis.answered() < end) {
      basis.answer_next(crew);
      basis.add(basis.answers().col(basis.answered() - 1));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.projected());
    const auto m = static_cast<Eigen::Index>(basis.answered());
    const Eigen::Index n = std::min<Eigen::Index>(task.n, m);
    // The largest answer is the slowest.
    const Eigen::VectorXd theta = ritz.eigenvalues().tail(n).reverse();
    const Eigen::MatrixXd weights = ritz.eigenvectors().rightCols(n).rowwise().reverse();
    modes.omega2 = theta.cwiseInverse().array() - body.shift();
    modes.shape = basis.vectors().leftCols(m) * weights;
    const Eigen::MatrixXd off = basis.answers() * weights - modes.shape * theta.asDiagonal();
    modes.residual = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      modes.residual = std::max(modes.residual, basis.norm(off.col(i)) / theta[i]);
    modes.solves = basis.answered();
    modes.converged = modes.residual <= task.tolerance && (n == task.n || basis.answered() == basis.size());
    if (modes.converged) break;
  }
  return modes;
}

}  // namespace palpate::physics
