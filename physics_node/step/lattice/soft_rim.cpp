#include "physics_node/step/lattice/soft_rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics_node/material/lame.h"

namespace palpate::physics {
namespace {

constexpr double most_stiffened = 4;
constexpr double towards_held = 0.86;  // Why: measured on slabs of 4, 8 and 16 cells on bone

double stiffened(double r_over_H) noexcept {
  return std::min(most_stiffened, 1 / std::max(1 - towards_held * r_over_H, 1 / most_stiffened));
}

/// Cosine from the push. Why: what is held aside, as the floor of a body that is pushed in its side, stiffens it much less.
constexpr double where_it_goes = 0.8;

/// Corners of a cell on one of its faces: -x, +x, -y, +y, -z, +z.
bool is_on(unsigned corner, std::size_t face) noexcept { return (corner >> face / 2 & 1) == (face & 1); }

}  // namespace

template <class Real>
SoftRim<Real>::SoftRim(const Body& body) {
  const SolidElements& solid = *body.solid;
  const double nu = solid.poisson_ratio, mu = lame_of(solid.modulus, nu).mu;
  k_n_ = mu * (2 - nu) / (1 - nu);
  k_t_ = 2 * mu * (1 - 2 * nu) / (3 - 4 * nu);
  c_ = std::sqrt(mu * solid.density);
  for (const Index node : body.nodes())
    if (body.inverse_mass[static_cast<std::size_t>(node)] == 0 && !body.is_beyond(node))
      held_.push_back(body.rest_position(node));
  const auto n = static_cast<std::size_t>(body.capacity());
  number_ = ZeroedArray<std::int32_t>(n);
  for (auto& axis : before_) axis = ZeroedArray<Real>(n);
  nodes_.reserve(body.nodes().size());
  faces_.reserve(body.nodes().size());
  before_nodes_.reserve(body.nodes().size());
}

template <class Real>
void SoftRim<Real>::find(const Body& body, const HexGrid& grid, std::span<const Index> acting,
                         std::span<const std::uint8_t> marks, const LatticeState<Real>& state) noexcept {
  before_nodes_.clear();
  for (const Node& node : nodes_) {
    before_nodes_.push_back(node.cell);
    number_[static_cast<std::size_t>(node.cell)] = 0;
  }
  nodes_.clear();
  faces_.clear();
  const auto& stiffness = body.solid->stiffness;
  const CellNet* net = body.cell_net();
  const Vec3 h = body.lattice.step;
  const std::array<double, 3> area{h.y() * h.z(), h.x() * h.z(), h.x() * h.y()};
  const auto add = [&](Index node, std::size_t axis, double quarter, double behind) {
    const auto n = static_cast<std::size_t>(node);
    if (state.inverse_mass[n] == 0) return;
    if (number_[n] == 0) {
      nodes_.push_back({.cell = node, .inverse_mass = state.inverse_mass[n]});
      faces_.emplace_back();
      number_[n] = static_cast<std::int32_t>(nodes_.size());
    }
    Faces& faces = faces_[static_cast<std::size_t>(number_[n]) - 1];
    faces.of_modulus[static_cast<Eigen::Index>(axis)] += behind * quarter;
    faces.of_impedance[static_cast<Eigen::Index>(axis)] += std::sqrt(behind) * quarter;
  };
  for (const Index r : acting) {
    const HexRun& run = grid.runs[static_cast<std::size_t>(r)];
    const std::array<Index, 6> beside{run.right - 1, run.right, -grid.up_y, grid.up_y, -grid.up_z, grid.up_z};
    for (Index i = run.first; i < run.first + run.count; ++i) {
      if ((marks[static_cast<std::size_t>(i)] & cell_acts) == 0) continue;
      for (std::size_t face = 0; face < 6; ++face) {
        const auto other = static_cast<std::size_t>(i + beside[face]);
        if (stiffness[other] <= 0 || (marks[other] & cell_acts) != 0) continue;
        if (net != nullptr && net->is_open(i, face)) continue;
        const double quarter = ((face & 1) != 0 ? 0.25 : -0.25) * area[face / 2];
        const std::array<Index, 8> corners = corners_now(body, grid, run, i);
        for (unsigned a = 0; a < 8; ++a)
          if (is_on(a, face)) add(corners[a], face / 2, quarter, static_cast<double>(stiffness[other]));
      }
    }
  }
  for (const Index node : before_nodes_) {
    const auto n = static_cast<std::size_t>(node);
    if (number_[n] != 0) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      lost_ += 0.5 * state.dt_before * static_cast<double>(state.v[a][n] * before_[a][n]);
      before_[a][n] = 0;
    }
  }
}

template <class Real>
double SoftRim<Real>::way_to_held(const PressedPlace& place) const noexcept {
  double nearest2 = std::numeric_limits<double>::infinity();
  const double least = where_it_goes * place.push.norm();
  for (const Vec3& x : held_) {
    const Vec3 way = x - place.at;
    const double way2 = way.squaredNorm();
    if (way2 < nearest2 && way.dot(place.push) >= least * std::sqrt(way2)) nearest2 = way2;
  }
  return std::sqrt(nearest2);
}

template <class Real>
void SoftRim<Real>::stiffen(const Body& body, std::span<const PressedPlace> places) noexcept {
  std::array<double, PressedPlaces::most> H;
  double weights = 0;
  for (std::size_t q = 0; q < places.size(); ++q) {
    H[q] = way_to_held(places[q]);
    weights += places[q].weight;
  }
  const double least_r = body.lattice.step.minCoeff();
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Vec3 x = body.lattice.rest_position(nodes_[n].cell);
    Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
    Vec3 c = Vec3::Zero();
    double sum = 0;
    for (std::size_t q = 0; q < places.size(); ++q) {
      const double r = std::max((x - places[q].at).norm(), least_r);
      const Vec3 along = (x - places[q].at) / r;
      const double share = (weights > 0 ? places[q].weight : 1) / r;
      const double k = share * std::max(0.0, faces_[n].of_modulus.dot(along)) / r * stiffened(r / H[q]);
      const Eigen::Matrix3d nn = along * along.transpose();
      K += k * (k_n_ * nn + k_t_ * (Eigen::Matrix3d::Identity() - nn));
      c += share * std::max(0.0, faces_[n].of_impedance.dot(along)) * c_ *
           (Vec3::Ones() + along.cwiseProduct(along));
      sum += share;
    }
    if (sum > 0) K /= sum, c /= sum;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto i = static_cast<Eigen::Index>(a);
      nodes_[n].K[a] = static_cast<Real>(K(i, i));
      nodes_[n].c[a] = static_cast<Real>(c[i]);
    }
    nodes_[n].K[3] = static_cast<Real>(K(0, 1));
    nodes_[n].K[4] = static_cast<Real>(K(0, 2));
    nodes_[n].K[5] = static_cast<Real>(K(1, 2));
  }
  use_step(std::exchange(dt_, -1.0));
}

template <class Real>
void SoftRim<Real>::use_step(double dt) noexcept {
  if (dt == dt_) return;
  dt_ = dt;
  for (Node& node : nodes_)
    for (std::size_t a = 0; a < 3; ++a)
      node.c_now[a] = node.c[a] / (1 + static_cast<Real>(dt) * node.inverse_mass * node.c[a]);
}

/// K u
template <class Real>
std::array<Real, 3> SoftRim<Real>::pull(const Node& node, const LatticeState<Real>& state) const noexcept {
  const auto i = static_cast<std::size_t>(node.cell);
  const Real x = state.u[0][i], y = state.u[1][i], z = state.u[2][i];
  const auto& K = node.K;
  return {K[0] * x + K[3] * y + K[4] * z, K[3] * x + K[1] * y + K[5] * z, K[4] * x + K[5] * y + K[2] * z};
}

/// The damper's loss in a step is that of the leapfrog's energy: dt v . (F + F_before) / 2, v between the two.
template <class Real>
void SoftRim<Real>::act(LatticeState<Real>& state, double dt, bool watch) noexcept {
  use_step(dt);
  double lost = 0, elastic = 0;
  for (const Node& node : nodes_) {
    const auto i = static_cast<std::size_t>(node.cell);
    const std::array<Real, 3> spring = pull(node, state);
    Real passed = 0, held = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Real damper = node.c_now[a] * state.v[a][i];
      passed += state.v[a][i] * (damper + before_[a][i]);
      held += state.u[a][i] * spring[a];
      before_[a][i] = damper;
      state.f[a][i] -= spring[a] + damper;
    }
    lost += static_cast<double>(passed);
    elastic += static_cast<double>(held);
  }
  lost_ += 0.5 * state.dt_before * lost;
  if (watch) watched_ = 0.5 * elastic;
}

template <class Real>
double SoftRim<Real>::elastic(const LatticeState<Real>& state) const noexcept {
  double sum = 0;
  for (const Node& node : nodes_) {
    const std::array<Real, 3> spring = pull(node, state);
    for (std::size_t a = 0; a < 3; ++a)
      sum += 0.5 * static_cast<double>(spring[a] * state.u[a][static_cast<std::size_t>(node.cell)]);
  }
  return sum;
}

template <class Real>
double SoftRim<Real>::power(const LatticeState<Real>& state) const noexcept {
  double sum = 0;
  for (const Node& node : nodes_) {
    const std::array<Real, 3> spring = pull(node, state);
    for (std::size_t a = 0; a < 3; ++a)
      sum -= static_cast<double>(spring[a] * state.v[a][static_cast<std::size_t>(node.cell)]);
  }
  return sum;
}

template <class Real>
void SoftRim<Real>::add(const LatticeState<Real>& state, Energies& energies) const noexcept {
  energies.elastic += elastic(state);
  double all = power(state);
  for (const Node& node : nodes_)
    for (std::size_t a = 0; a < 3; ++a) {
      const Real v = state.v[a][static_cast<std::size_t>(node.cell)];
      all -= static_cast<double>(node.c_now[a] * v * v);
    }
  energies.between += 0.5 * state.dt_before * all;
}

template <class Real>
double SoftRim<Real>::due(const LatticeState<Real>& state) const noexcept {
  double passed = 0;
  for (const Node& node : nodes_) {
    const auto i = static_cast<std::size_t>(node.cell);
    for (std::size_t a = 0; a < 3; ++a)
      passed += static_cast<double>(state.v[a][i] * (node.c_now[a] * state.v[a][i] + before_[a][i]));
  }
  return 0.5 * state.dt_before * passed;
}

template <class Real>
void SoftRim<Real>::clear() noexcept {
  for (const Node& node : nodes_) {
    const auto i = static_cast<std::size_t>(node.cell);
    number_[i] = 0;
    for (auto& axis : before_) axis[i] = 0;
  }
  nodes_.clear();
  faces_.clear();
  watched_ = lost_ = 0;
}

template class SoftRim<float>;
template class SoftRim<double>;

}  // namespace palpate::physics
