#include "bench/problems/lattice_statics.h"

#include <Eigen/Sparse>
#include <cmath>
#include <vector>

#include "common/error/error.h"

namespace palpate::bench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using physics::Index;

class Statics {
 public:
  Statics(const physics::Body& body, const Vec3& gravity)
      : body_(body), gravity_(gravity), number_(static_cast<std::size_t>(body.lattice.n_cells()), -1) {
    for (const Index cell : body.lattice.masses)
      if (body.inverse_mass[static_cast<std::size_t>(cell)] > 0)
        number_[static_cast<std::size_t>(cell)] = n_free_++;
    u_ = Eigen::VectorXd::Zero(3 * n_free_);
  }

  /// Newton's method; the first step is the linear answer.
  void solve() {
    for (int iteration = 0; iteration < 30; ++iteration) {
      assemble();
      const Eigen::VectorXd du = step();
      u_ += du;
      if (du.norm() <= 1e-14 * u_.norm()) return;
    }
  }

  /// The linear answer alone, by conjugate gradients without a matrix, scaled by the diagonal.
  void solve_linear() {
    const auto elements = list_elements();
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(u_.size());
    for (const Element& e : elements) {
      if (e.i >= 0) diagonal.segment<3>(3 * e.i) += e.k * e.n.cwiseAbs2();
      if (e.j >= 0) diagonal.segment<3>(3 * e.j) += e.k * e.n.cwiseAbs2();
    }
    Eigen::VectorXd r = weights(), z = r.cwiseQuotient(diagonal), p = z, Kp(u_.size());
    const double enough = 1e-7 * r.norm();
    double rz = r.dot(z);
    while (r.norm() > enough) {
      Kp.setZero();
      for (const Element& e : elements) {
        double stretch = 0;
        if (e.j >= 0) stretch += e.n.dot(p.segment<3>(3 * e.j));
        if (e.i >= 0) stretch -= e.n.dot(p.segment<3>(3 * e.i));
        if (e.j >= 0) Kp.segment<3>(3 * e.j) += e.k * stretch * e.n;
        if (e.i >= 0) Kp.segment<3>(3 * e.i) -= e.k * stretch * e.n;
      }
      const double alpha = rz / p.dot(Kp);
      u_ += alpha * p;
      r -= alpha * Kp;
      z = r.cwiseQuotient(diagonal);
      const double next = r.dot(z);
      p = z + next / rz * p;
      rz = next;
    }
  }

  Vec3 at(Index cell) const {
    const Index n = number_[static_cast<std::size_t>(cell)];
    return n < 0 ? Vec3(Vec3::Zero()) : Vec3(u_.segment<3>(3 * n));
  }

 private:
  struct Element {
    Index i = -1, j = -1;  // numbers of its free masses
    Vec3 n;                // along it at rest
    double k = 0;
  };

  std::vector<Element> list_elements() const {
    const physics::Lattice& lattice = body_.lattice;
    std::vector<Element> elements;
    for (const Index cell : lattice.masses)
      for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
        if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) == 0) continue;
        const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
        elements.push_back({number_[static_cast<std::size_t>(cell)], number_[static_cast<std::size_t>(other)],
                            lattice.rest_vector[d] / lattice.rest_length[d], body_.law.k1[d]});
      }
    return elements;
  }

  Eigen::VectorXd weights() const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * n_free_);
    for (const Index cell : body_.lattice.masses)
      if (const Index i = number_[static_cast<std::size_t>(cell)]; i >= 0)
        f.segment<3>(3 * i) = gravity_ / body_.inverse_mass[static_cast<std::size_t>(cell)];
    return f;
  }

  void assemble() {
    triplets_.clear();
    residual_ = weights();
    const physics::Lattice& lattice = body_.lattice;
    for (const Index cell : lattice.masses) {
      const Index i = number_[static_cast<std::size_t>(cell)];
      for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
        if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) == 0) continue;
        const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
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
    // A single element resists only along itself; so little across it changes the path of the iteration, not its end.
    const double little = 1e-12 * K.diagonal().maxCoeff();
    K.diagonal().array() += little;
    if (!analysed_) cholesky_.analyzePattern(K), analysed_ = true;
    cholesky_.factorize(K);
    PALPATE_CHECK(cholesky_.info() == Eigen::Success, "the lattice is not held enough to be in equilibrium");
    return cholesky_.solve(residual_);
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

Eigen::Matrix3Xd displacements(const physics::Body& body, const Statics& statics) {
  Eigen::Matrix3Xd u(3, body.lattice.n_masses());
  for (Eigen::Index n = 0; n < u.cols(); ++n)
    u.col(n) = statics.at(body.lattice.masses[static_cast<std::size_t>(n)]);
  return u;
}

void check(const physics::Body& body) {
  PALPATE_CHECK(body.n_held > 0 && body.law_of.empty() && !body.law.yields,
                "a held body of one elastic material");
}

}  // namespace

Eigen::Matrix3Xd equilibrium(const physics::Body& body, const Vec3& gravity) {
  check(body);
  Statics statics(body, gravity);
  statics.solve();
  return displacements(body, statics);
}

Eigen::Matrix3Xd linear_equilibrium(const physics::Body& body, const Vec3& gravity) {
  check(body);
  Statics statics(body, gravity);
  statics.solve_linear();
  return displacements(body, statics);
}

}  // namespace palpate::bench
