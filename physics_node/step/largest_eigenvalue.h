#pragma once
// The largest eigenvalue of a symmetric operation that is known by what it does only.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <vector>

namespace palpate::physics {

/// By Lanczos, at most 60 applications: the largest found, and at most how far it may be from one, together. It lies below the
/// largest only where the start has nothing of that, which random numbers do not.
/// @param operation  apply(x, y): y = A x, of vectors with n entries
template <class Operation>
double largest_eigenvalue(Operation& operation, Eigen::Index n) {
  constexpr int most = 60;
  constexpr double close = 0.01;  // of it
  std::mt19937_64 engine(1);
  Eigen::VectorXd v(n), before = Eigen::VectorXd::Zero(n), w(n);
  for (double& entry : v) entry = static_cast<double>(engine() >> 11) * 0x1p-52 - 1;
  v.normalize();
  std::vector<double> a, b;
  double largest = 0, residual = 0;
  for (int k = 0; k < most && k < n; ++k) {
    operation.apply(v, w);
    a.push_back(v.dot(w));
    w -= a.back() * v;
    if (k > 0) w -= b.back() * before;
    b.push_back(w.norm());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved;
    const auto size = static_cast<Eigen::Index>(a.size());
    solved.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(a.data(), size),
                                  Eigen::Map<Eigen::VectorXd>(b.data(), size - 1));
    largest = solved.eigenvalues()[size - 1];
    residual = b.back() * std::abs(solved.eigenvectors()(size - 1, size - 1));
    if (residual <= close * largest) break;
    before = v;
    v = w / b.back();
  }
  return largest + residual;
}

}  // namespace palpate::physics
