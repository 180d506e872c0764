#include "physics_node/step/lattice/hex_spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "physics_node/step/fem/hex_stiffness.h"
#include "physics_node/step/largest_eigenvalue.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {
namespace {

HexMaterial material_of(const Body& body) {
  return {.modulus = body.solid->modulus,
          .poisson_ratio = body.solid->poisson_ratio,
          .hourglass = body.solid->hourglass};
}

double largest_of_one_cell(const Body& body) {
  const Eigen::SelfAdjointEigenSolver<HexMatrix> solved(hex_stiffness(material_of(body), body.lattice.step),
                                                        Eigen::EigenvaluesOnly);
  return body.solid->largest_stiffness * solved.eigenvalues()[23] * 8 /
         (body.solid->density * body.lattice.step.prod());
}

/// y = M^-1/2 K M^-1/2 x on the nodes that may move.
class ScaledStiffness {
 public:
  /// @param counts  1: cells of this lowest corner have a stiffness; EMPTY: all have
  ScaledStiffness(const Body& body, std::span<const std::uint8_t> counts)
      : body_(body),
        grid_(make_hex_grid(body)),
        size_(1e-6 * body.lattice.step.minCoeff()),
        kernel_(hex_kernel_here<double>({.physical = body.solid->hourglass == HourglassKind::physical})) {
    const auto n = static_cast<std::size_t>(body.capacity());
    std::size_t colour = 0;
    for (auto* three : {&u_, &low_, &high_})
      for (auto& axis : *three) axis = ZeroedArray<double>(n, colour++);
    stiffness_ = ZeroedArray<double>(n, colour++);
    for (const Index cell : body.lattice.masses) {
      const auto i = static_cast<std::size_t>(cell);
      if (counts.empty() || counts[i] != 0) stiffness_[i] = static_cast<double>(body.solid->stiffness[i]);
      if (body.inverse_mass[i] > 0) nodes_.push_back(cell);
    }
    elastic_.resize(grid_.runs.size());
    m_.runs = grid_.runs.data();
    m_.runs_of_row = grid_.runs_of_row.data();
    m_.stiffness = stiffness_.data();
    m_.elastic = m_.least_J = m_.stiffest = elastic_.data();
    m_.up_y = grid_.up_y, m_.up_z = grid_.up_z;
    m_.books = true;  // and does not watch
    m_.k = hex_constants<double>(material_of(body), body.lattice.step);
    for (std::size_t c = 0; c < 3; ++c) {
      m_.masses.u[c] = u_[c].data();
      m_.masses.f[c] = low_[c].data();
      m_.high[c] = high_[c].data();
    }
  }

  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(nodes_.size()); }

  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    const double one = size_ / x.cwiseAbs().maxCoeff();  // small, so that it is linear
    each([&](std::size_t c, std::size_t i, Eigen::Index n, double root) { u_[c][i] = one * root * x[n]; });
    kernel_.forces(m_, 0, static_cast<Index>(grid_.runs.size()));
    each([&](std::size_t c, std::size_t i, Eigen::Index n, double root) {
      y[n] = -root / one * (low_[c][i] + high_[c][i]);
    });
    for (const Index node : body_.lattice.masses)
      for (std::size_t c = 0; c < 3; ++c)
        low_[c][static_cast<std::size_t>(node)] = high_[c][static_cast<std::size_t>(node)] = 0;
  }

 private:
  /// visit(component, storage cell, number in a vector, root of inverse mass)
  template <class Visit>
  void each(const Visit& visit) const {
    Eigen::Index n = 0;
    for (const Index node : nodes_) {
      const auto i = static_cast<std::size_t>(node);
      const double root = std::sqrt(body_.inverse_mass[i]);
      for (std::size_t c = 0; c < 3; ++c) visit(c, i, n++, root);
    }
  }

  const Body& body_;
  HexGrid grid_;
  double size_;
  Three<double> u_, low_, high_;
  ZeroedArray<double> stiffness_;
  std::vector<double> elastic_;
  std::vector<Index> nodes_;
  HexKernel<double> kernel_;
  HexContext<double> m_ = {};
};

}  // namespace

StiffestMode stiffest_mode_of_hexahedra(const Body& body) {
  StiffestMode mode;
  if (body.n_held == body.n_nodes()) return mode;
  mode.omega2 = largest_of_one_cell(body);
  if (body.cell_net() == nullptr) {
    ScaledStiffness operation(body, {});
    mode.omega2 = std::min(mode.omega2, largest_eigenvalue(operation, operation.size()));
  }
  mode.gamma = body.solid->beta * mode.omega2;
  return mode;
}

StiffestMode stiffest_mode_of_hexahedra(const Body& body, std::span<const std::uint8_t> counts) {
  StiffestMode mode;
  if (body.n_held == body.n_nodes()) return mode;
  ScaledStiffness operation(body, counts);
  mode.omega2 = largest_eigenvalue(operation, operation.size());
  mode.gamma = body.solid->beta * mode.omega2;
  return mode;
}

}  // namespace palpate::physics
