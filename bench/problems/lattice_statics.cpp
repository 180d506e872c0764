#include "bench/problems/lattice_statics.h"

#include <Eigen/Sparse>
#include <cmath>
#include <vector>

#include "common/error/error.h"

namespace palpate::bench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using physics::Index;

constexpr Index small = 3000;  // masses; above, the factors fill up

class Statics {
 public:
  Statics(const physics::Body& body, const Vec3& gravity)
      : body_(body), gravity_(gravity), number_(static_cast<std::size_t>(body.lattice.n_cells()), -1) {
    for (const Index cell : body.lattice.masses)
      if (body.inverse_mass[static_cast<std::size_t>(cell)] > 0)
        number_[static_cast<std::size_t>(cell)] = n_free_++;
    u_ = Eigen::VectorXd::Zero(3 * n_free_);
  }

  Eigen::VectorXd solve() {
    double first = 0;
    for (int iteration = 0; iteration < 30; ++iteration) {
      assemble();
      const double size = residual_.norm();
      if (iteration == 0) first = size;
      if (size <= 2e-14 * first) return u_;
      const Eigen::VectorXd du = step();
      u_ += du;
      if (du.norm() <= (is_small() ? 1e-14 : 1e-5) * u_.norm())
        return u_;  // quadratic: the next would be nothing
    }
    return u_;
  }

  Vec3 at(Index cell) const {
    const Index n = number_[static_cast<std::size_t>(cell)];
    return n < 0 ? Vec3(Vec3::Zero()) : Vec3(u_.segment<3>(3 * n));
  }

 private:
  bool is_small() const { return n_free_ <= small; }

  void assemble() {
    triplets_.clear();
    residual_ = Eigen::VectorXd::Zero(3 * n_free_);
    const physics::Lattice& lattice = body_.lattice;
    for (const Index cell : lattice.masses) {
      const Index i = number_[static_cast<std::size_t>(cell)];
      if (i >= 0)
        residual_.segment<3>(3 * i) += gravity_ / body_.inverse_mass[static_cast<std::size_t>(cell)];
      const auto parity = static_cast<std::size_t>(lattice.row_parity(cell));
      for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
        if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) == 0) continue;
        const Index other = cell + lattice.offset[parity][d];
        add_element(i, number_[static_cast<std::size_t>(other)],
                    lattice.rest_vector[d] + at(other) - at(cell), lattice.rest_length[d], body_.law.k1[d]);
      }
    }
  }

  void add_element(Index i, Index j, const Vec3& x, double L, double k1) {
    const double l = x.norm();
    const Vec3 u = x / l;
    const Vec3 f = k1 * (l - L) * u;
    const Eigen::Matrix3d uu = u * u.transpose();
    const Eigen::Matrix3d K = k1 * (uu + (1 - L / l) * (Eigen::Matrix3d::Identity() - uu));
    if (i >= 0) residual_.segment<3>(3 * i) += f, add_block(i, i, K);
    if (j >= 0) residual_.segment<3>(3 * j) -= f, add_block(j, j, K);
    if (i >= 0 && j >= 0) add_block(i, j, -K), add_block(j, i, -K);
  }

  void add_block(Index i, Index j, const Eigen::Matrix3d& K) {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) triplets_.emplace_back(3 * i + a, 3 * j + b, K(a, b));
  }

  Eigen::VectorXd step() {
    Sparse K(3 * n_free_, 3 * n_free_);
    K.setFromTriplets(triplets_.begin(), triplets_.end());
    if (is_small()) {
      if (!analysed_) cholesky_.analyzePattern(K), analysed_ = true;
      cholesky_.factorize(K);
      PALPATE_CHECK(cholesky_.info() == Eigen::Success,
                    "the lattice is not held enough to be in equilibrium");
      return cholesky_.solve(residual_);
    }
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double>>
        gradients(K);
    gradients.setTolerance(1e-7);
    return gradients.solve(residual_);
  }

  const physics::Body& body_;
  Vec3 gravity_;
  std::vector<Index> number_;  // of each storage cell among the free masses, -1: held or empty
  Index n_free_ = 0;
  Eigen::VectorXd u_, residual_;
  std::vector<Eigen::Triplet<double>> triplets_;
  Eigen::SimplicialLLT<Sparse> cholesky_;
  bool analysed_ = false;
};

}  // namespace

Eigen::Matrix3Xd equilibrium(const physics::Body& body, const Vec3& gravity) {
  PALPATE_CHECK(body.n_held > 0 && body.law_of.empty() && !body.law.yields,
                "a held body of one elastic material");
  Statics statics(body, gravity);
  statics.solve();
  Eigen::Matrix3Xd u(3, body.lattice.n_masses());
  for (Eigen::Index n = 0; n < u.cols(); ++n)
    u.col(n) = statics.at(body.lattice.masses[static_cast<std::size_t>(n)]);
  return u;
}

}  // namespace palpate::bench
