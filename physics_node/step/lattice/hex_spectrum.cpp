#include "physics_node/step/lattice/hex_spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>
#include <type_traits>
#include <vector>

#include "physics_node/step/fem/hex_stiffness.h"
#include "physics_node/step/largest_eigenvalue.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {
namespace {

constexpr Index many_nodes = 1'000'000;

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

/// y = M^-1/2 K M^-1/2 x on all nodes; those that are held stand.
template <class Real>
class ScaledStiffness {
 public:
  using Vector = Eigen::VectorX<Real>;

  /// @param counts  1: cells of this lowest corner have a stiffness; EMPTY: all have
  ScaledStiffness(const Body& body, std::span<const std::uint8_t> counts)
      : rows_(body.lattice.rows),
        n_nodes_(std::accumulate(rows_.begin(), rows_.end(), Eigen::Index{0},
                                 [](Eigen::Index sum, const RowSegment& row) { return sum + row.count; })),
        grid_(make_hex_grid(body)),
        size_(linear_strain * static_cast<Real>(body.lattice.step.minCoeff())),
        kernel_(hex_kernel_here<Real>({.physical = body.solid->hourglass == HourglassKind::physical})) {
    const auto n = static_cast<std::size_t>(body.capacity());
    std::size_t colour = 0;
    for (auto* three : {&u_, &low_, &high_})
      for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
    stiffness_ = ZeroedArray<Real>(n, colour++);
    stiffness_.will_be_filled();
    for (auto* three : {&u_, &low_, &high_})
      for (auto& axis : *three) axis.will_be_filled();
    root_.resize(n_nodes_);
    each_row([&](Index first, Index count, Eigen::Index at) {
      for (Index k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(first + k);
        if (counts.empty() || counts[i] != 0) stiffness_[i] = static_cast<Real>(body.solid->stiffness[i]);
        root_[at + k] = static_cast<Real>(std::sqrt(body.inverse_mass[i]));
      }
    });
    largest_root_ = root_.maxCoeff();
    elastic_.resize(grid_.runs.size());
    m_.runs = grid_.runs.data();
    m_.runs_of_row = grid_.runs_of_row.data();
    m_.stiffness = stiffness_.data();
    m_.elastic = m_.least_J = m_.stiffest = elastic_.data();
    m_.up_y = grid_.up_y, m_.up_z = grid_.up_z;
    m_.books = true;  // and does not watch
    m_.k = hex_constants<Real>(material_of(body), body.lattice.step);
    for (std::size_t c = 0; c < 3; ++c) {
      m_.masses.u[c] = u_[c].data();
      m_.masses.f[c] = low_[c].data();
      m_.high[c] = high_[c].data();
    }
  }

  double largest() { return largest_eigenvalue<Real>(*this, 3 * n_nodes_); }

  void apply(const Vector& x, Vector& y) {
    const Real one = size_ / (largest_root_ * x.cwiseAbs().maxCoeff());
    each_row([&](Index first, Index count, Eigen::Index n) {
      for (std::size_t c = 0; c < 3; ++c)
        part(u_[c], first, count) = one * (root_.segment(n, count) * x.segment(number(c, n), count).array());
    });
    sweep();
    each_row([&](Index first, Index count, Eigen::Index n) {
      for (std::size_t c = 0; c < 3; ++c) {
        auto low = part(low_[c], first, count), high = part(high_[c], first, count);
        y.segment(number(c, n), count).array() = root_.segment(n, count) * (low + high) / -one;
        low.setZero(), high.setZero();
      }
    });
  }

 private:
  // Largest displacement over the smallest edge of a cell: small, so that laws are linear; in float not so small that 1 + it has no
  // digits left, which makes w^2 wrong by some thousandths.
  static constexpr Real linear_strain = std::is_same_v<Real, float> ? Real(1e-3) : Real(1e-6);
  static constexpr Eigen::Index worth_two_threads = 100'000;

  /// Of a scan on two cores: no two layers write the same number (hex_kernel.h).
  void sweep() {
    const auto all = static_cast<Index>(grid_.runs.size());
    if (n_nodes_ < worth_two_threads) return kernel_.forces(m_, 0, all);
    const Index middle = grid_.layers[grid_.layers.size() / 2].first_run;
    const std::jthread upper([&] { kernel_.forces(m_, middle, all); });
    kernel_.forces(m_, 0, middle);
  }

  /// visit(first storage cell, how many, number of the first among all nodes)
  template <class Visit>
  void each_row(const Visit& visit) const {
    Eigen::Index n = 0;
    for (const RowSegment& row : rows_) visit(row.first, row.count, n), n += row.count;
  }
  static Eigen::Map<Eigen::ArrayX<Real>> part(ZeroedArray<Real>& of, Index first, Index count) {
    return {of.data() + first, count};
  }
  /// Vectors hold x of all nodes, then y, then z.
  Eigen::Index number(std::size_t c, Eigen::Index node) const {
    return static_cast<Eigen::Index>(c) * n_nodes_ + node;
  }

  const std::vector<RowSegment>& rows_;
  Eigen::Index n_nodes_;
  HexGrid grid_;
  Real size_;
  Three<Real> u_, low_, high_;
  ZeroedArray<Real> stiffness_;
  Eigen::ArrayX<Real> root_;  // of the inverse mass; 0: held  (nodes)
  Real largest_root_ = 0;
  std::vector<double> elastic_;
  HexKernel<Real> kernel_;
  HexContext<Real> m_ = {};
};

/// Of a whole scan in float: in half the time and memory.
double largest_of_all(const Body& body, std::span<const std::uint8_t> counts) {
  if (body.lattice.n_masses() < many_nodes) return ScaledStiffness<double>(body, counts).largest();
  return ScaledStiffness<float>(body, counts).largest();
}

}  // namespace

StiffestMode stiffest_mode_of_hexahedra(const Body& body) {
  StiffestMode mode;
  if (body.n_held == body.n_nodes()) return mode;
  mode.omega2 = largest_of_one_cell(body);
  if (body.cell_net() == nullptr) mode.omega2 = std::min(mode.omega2, largest_of_all(body, {}));
  mode.gamma = body.solid->beta * mode.omega2;
  return mode;
}

StiffestMode stiffest_mode_of_hexahedra(const Body& body, std::span<const std::uint8_t> counts) {
  StiffestMode mode;
  if (body.n_held == body.n_nodes()) return mode;
  mode.omega2 = largest_of_all(body, counts);
  mode.gamma = body.solid->beta * mode.omega2;
  return mode;
}

}  // namespace palpate::physics
