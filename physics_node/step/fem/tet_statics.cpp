#include "physics_node/step/fem/tet_statics.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics_node/step/fem/coarse_grid.h"
#include "physics_node/step/fem/tet_stiffness.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::physics {
namespace {

constexpr int most_newton = 60, most_cg = 2000, most_halvings = 20;

/// The body, its free nodes one after the other in vectors.
class RestProblem {
 public:
  RestProblem(const TetModel& model, const Vec3& gravity) : body_(model), forces_(body_.n_nodes()) {
    std::vector<int> number(body_.n_nodes(), -1);
    for (Index n = 0; n < static_cast<Index>(body_.n_nodes()); ++n) {
      if (body_.inverse_mass(n) == 0) continue;
      number[static_cast<std::size_t>(n)] = static_cast<int>(nodes_.size());
      nodes_.push_back(n);
    }
    weight_.resize(size());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      weight_.segment<3>(3 * static_cast<Eigen::Index>(i)) = gravity / body_.inverse_mass(nodes_[i]);
    std::vector<Eigen::Triplet<double>> entries;
    const Eigen::SparseMatrix<double> all = tet_stiffness(model);
    for (int column = 0; column < all.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator e(all, column); e; ++e) {
        const int i = number[static_cast<std::size_t>(e.row() / 3)],
                  j = number[static_cast<std::size_t>(column / 3)];
        if (i >= 0 && j >= 0)
          entries.emplace_back(3 * i + static_cast<int>(e.row() % 3), 3 * j + column % 3, e.value());
      }
    at_rest_.resize(size(), size());
    at_rest_.setFromTriplets(entries.begin(), entries.end());
    // Of six tetrahedra a cube: 0.55 of the cube's edge. Nodes of second order lie half as far apart.
    edge_ = std::cbrt(signed_volume(model.mesh, model.mesh.tets[0])) * (model.mesh.middles.empty() ? 1 : 0.5);
  }

  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(nodes_.size()); }
  const SparseRows& at_rest() const { return at_rest_; }
  const Eigen::VectorXd& weight() const { return weight_; }
  double edge() const { return edge_; }
  std::vector<Vec3> places() const {
    std::vector<Vec3> x;
    for (const Index n : nodes_) x.push_back(body_.model().mesh.nodes[static_cast<std::size_t>(n)]);
    return x;
  }

  /// Elastic forces at u.
  void forces(const Eigen::VectorXd& u, Eigen::VectorXd& f) {
    put(u);
    body_.forces(forces_);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      f.segment<3>(3 * static_cast<Eigen::Index>(i)) = forces_[static_cast<std::size_t>(nodes_[i])];
  }
  double energy(const Eigen::VectorXd& u) {
    put(u);
    return body_.energies(Vec3::Zero()).elastic - weight_.dot(u);
  }
  std::vector<Vec3> displacements(const Eigen::VectorXd& u) {
    put(u);
    std::vector<Vec3> all;
    for (Index n = 0; n < static_cast<Index>(body_.n_nodes()); ++n) all.push_back(body_.displacement(n));
    return all;
  }

 private:
  void put(const Eigen::VectorXd& u) {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      body_.place(nodes_[i], u.segment<3>(3 * static_cast<Eigen::Index>(i)), Vec3::Zero());
  }

  Tetrahedra<double> body_;
  std::vector<Vec3> forces_;
  std::vector<Index> nodes_;  // that may move
  Eigen::VectorXd weight_;
  SparseRows at_rest_;
  double edge_ = 0;
};

/// z = about K^-1 r, of the stiffness near rest: symmetric and positive, whatever the body does now.
class Preconditioner {
 public:
  Preconditioner(const RestProblem& problem, TetPreconditioner kind) : k_(problem.at_rest()) {
    inverse_diagonal_ = k_.diagonal().cwiseInverse();
    if (kind == TetPreconditioner::diagonal) return;
    // Why 4: two edges of such a cube. Cells three times as wide take half as many applications again.
    grid_ = std::make_unique<CoarseGrid>(problem.places(), k_, 4 * problem.edge());
    Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(problem.size(), -1, 1).array().sin().matrix();
    for (Eigen::Index i = 0; i < v.size(); i += 2) v[i] = -v[i];
    for (int n = 0; n < 20; ++n) {
      v = inverse_diagonal_.cwiseProduct(k_ * v);
      largest_ = v.norm();
      v /= largest_;
    }
    largest_ *= 1.2;  // Why: what twenty rounds may still miss
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& r, int& applications) const {
    if (grid_ == nullptr) return inverse_diagonal_.cwiseProduct(r);
    Eigen::VectorXd z = smooth(r);
    grid_->correct(r - k_ * z, z);
    z += smooth(r - k_ * z);
    applications += 4;
    return z;
  }

 private:
  /// Chebyshev's polynomial of second degree on the upper seven eighths of the spectrum, from zero.
  Eigen::VectorXd smooth(const Eigen::VectorXd& r) const {
    const double low = largest_ / 8, middle = (largest_ + low) / 2, half = (largest_ - low) / 2;
    const double rho = half / middle, next = 1 / (2 * middle / half - rho);
    Eigen::VectorXd z = inverse_diagonal_.cwiseProduct(r) / middle;
    z += next * rho * z + 2 * next / half * inverse_diagonal_.cwiseProduct(r - k_ * z);
    return z;
  }

  const SparseRows& k_;
  Eigen::VectorXd inverse_diagonal_;
  std::unique_ptr<CoarseGrid> grid_;
  double largest_ = 0;  // eigenvalue of D^-1 K
};

/// Solves K(u) x = r by conjugate gradients; ends early where curvature is not positive.
Eigen::VectorXd newton_step(RestProblem& problem, const Preconditioner& precondition,
                            const Eigen::VectorXd& u, const Eigen::VectorXd& f, const Eigen::VectorXd& load,
                            double tolerance, int& applications) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(load.size()), r = load, q(load.size());
  Eigen::VectorXd z = precondition(r, applications), p = z;
  double rz = r.dot(z);
  for (int n = 0; n < most_cg && r.norm() > tolerance * load.norm(); ++n) {
    const double small = 1e-7 * problem.edge() / p.cwiseAbs().maxCoeff();
    problem.forces(u + small * p, q);
    q = (f - q) / small;
    ++applications;
    const double curvature = p.dot(q);
    if (curvature <= 0) return n == 0 ? p : x;
    x += rz / curvature * p;
    r -= rz / curvature * q;
    z = precondition(r, applications);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return x;
}

}  // namespace

StaticRest find_rest(const TetModel& model, const StaticLoad& load) {
  RestProblem problem(model, load.gravity);
  const Preconditioner precondition(problem, load.preconditioner);
  StaticRest rest;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size()), f(problem.size());
  const double weight = problem.weight().norm();
  double energy = problem.energy(u);
  for (; rest.newton <= most_newton; ++rest.newton) {
    problem.forces(u, f);
    const Eigen::VectorXd left = f + problem.weight();
    rest.residual = weight > 0 ? left.norm() / weight : 0;
    rest.solved = rest.residual <= load.tolerance;
    if (rest.solved || rest.newton == most_newton) break;
    const double tolerance = std::clamp(0.5 * load.tolerance / rest.residual, 1e-9, 0.1);
    const Eigen::VectorXd x = newton_step(problem, precondition, u, f, left, tolerance, rest.applications);
    double share = 1, there = problem.energy(u + x);
    for (int n = 0; n < most_halvings && !(there <= energy - 1e-4 * share * left.dot(x)); ++n)
      share /= 2, there = problem.energy(u + share * x);
    // Near the end an energy cannot tell any more; then the step is taken as it is.
    if (there > energy && rest.residual < 1e-3) share = 1, there = problem.energy(u + x);
    u += share * x;
    energy = there;
  }
  rest.displacement = problem.displacements(u);
  return rest;
}

}  // namespace palpate::physics
