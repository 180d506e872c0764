#pragma once
// The largest eigenvalue of a symmetric operation that is known by what it does only.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <vector>

namespace palpate::physics {

/// By Lanczos, 20 to 60 applications, of millions fewer: the largest found, and at most how far it may be from one, together. It lies below
/// the largest only where the start has next to nothing of that.
/// @param operation  apply(x, y): y = A x, of vectors with n entries
/// @tparam Real  of these vectors; float is enough where A is known to a thousandth, and reads half
template <class Real = double, class Operation>
double largest_eigenvalue(Operation& operation, Eigen::Index n) {
  using Vector = Eigen::VectorX<Real>;
  constexpr int most = 60;
  const bool many = n >= 3'000'000;
  // Why so many: near another eigenvalue a residual is small long before the largest shows, which cost 2 % of w^2 with some starts.
  const int least = many ? 0 : 20;
  // Of it. Why less close where there are millions: it is too large by 1 % then, a step too short by half of that, and seconds are saved.
  const double close = many ? 0.05 : 0.01;
  std::mt19937_64 engine(1);
  Vector v(n), before = Vector::Zero(n), w(n);
  for (Real& entry : v) entry = static_cast<Real>(static_cast<double>(engine() >> 11) * 0x1p-52 - 1);
  v.normalize();
  std::vector<double> a, b;
  double largest = 0, residual = 0;
  for (int k = 0; k < most && k < n; ++k) {
    operation.apply(v, w);
    a.push_back(static_cast<double>(v.dot(w)));
    w -= static_cast<Real>(a.back()) * v + static_cast<Real>(k > 0 ? b.back() : 0) * before;
    b.push_back(static_cast<double>(w.norm()));
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved;
    const auto size = static_cast<Eigen::Index>(a.size());
    solved.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(a.data(), size),
                                  Eigen::Map<Eigen::VectorXd>(b.data(), size - 1));
    largest = solved.eigenvalues()[size - 1];
    residual = b.back() * std::abs(solved.eigenvectors()(size - 1, size - 1));
    const bool has_all = b.back() <= 1e-6 * largest;  // there is nothing left that differs
    if (has_all || (k + 1 >= least && residual <= close * largest)) break;
    before.swap(v);
    v.swap(w);
    v *= static_cast<Real>(1 / b.back());
  }
  return largest + residual;
}

}  // namespace palpate::physics
