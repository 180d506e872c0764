#include "bench/solids/hex_block.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>

#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::bench {
namespace {

using physics::HexMatrix;
using One = physics::Scalar<double>;

physics::HexForces<One> forces_of(const physics::HexMaterial& material,
                                  const physics::HexConstants<double>& k,
                                  const Eigen::Matrix<double, 3, 8>& u) {
  physics::Corners<One> w;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 8; ++a)
      w[c][a] = u(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(a));
  physics::HexForces<One> out;
  if (material.hourglass == HourglassKind::physical)
    physics::hex_forces<One, physics::StableNeoHookean, true, true>(k, w, out);
  else
    physics::hex_forces<One, physics::StableNeoHookean, false, true>(k, w, out);
  return out;
}

Eigen::Matrix<double, 24, 1> vector_of(const physics::HexForces<One>& forces) {
  Eigen::Matrix<double, 24, 1> f;
  for (std::size_t e = 0; e < 24; ++e) f[static_cast<Eigen::Index>(e)] = forces.f[e % 3][e / 3];
  return f;
}

}  // namespace

HexBlock::HexBlock(const std::array<int, 3>& cells, const Vec3& edge, const physics::HexMaterial& material,
                   const std::function<double(const Vec3&)>& stiffness)
    : material_(material), k_(physics::hex_constants<double>(material, edge)), edge_(edge) {
  std::map<std::array<int, 3>, int> numbers;  // by z, y, x
  const auto number = [&](int i, int j, int k) {
    const auto [found, fresh] = numbers.try_emplace({k, j, i}, n_nodes());
    if (fresh) rest_.push_back(edge.cwiseProduct(Vec3(i, j, k)));
    return found->second;
  };
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const double of_cell = stiffness ? stiffness(edge.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5))) : 1;
        if (of_cell == 0) continue;
        stiffness_.push_back(of_cell);
        auto& corner = corner_.emplace_back();
        for (int a = 0; a < 8; ++a)
          corner[static_cast<std::size_t>(a)] = number(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
      }
  held_.assign(3 * rest_.size(), 0);
  u_ = load_ = force_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held_.size()));
}

std::vector<int> HexBlock::nodes(const std::function<bool(const Vec3&)>& picks) const {
  std::vector<int> found;
  for (int n = 0; n < n_nodes(); ++n)
    if (picks(rest(n))) found.push_back(n);
  return found;
}

std::vector<std::array<int, 4>> HexBlock::faces(
    const std::function<bool(const Vec3&, const Vec3&)>& picks) const {
  std::map<std::array<int, 4>, std::pair<int, Vec3>> seen;  // sorted corners: how often, outward normal
  for (const auto& corner : corner_)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        std::array<int, 4> face;
        std::size_t n = 0;
        for (std::size_t a = 0; a < 8; ++a)
          if ((a >> axis & 1) == side) face[n++] = corner[a];
        std::ranges::sort(face);
        auto& [count, normal] = seen[face];
        ++count;
        normal = (side == 1 ? 1 : -1) * Vec3::Unit(static_cast<Eigen::Index>(axis));
      }
  std::vector<std::array<int, 4>> found;
  for (const auto& [face, what] : seen) {
    Vec3 middle = Vec3::Zero();
    for (const int n : face) middle += 0.25 * rest(n);
    if (what.first == 1 && picks(what.second, middle)) found.push_back(face);
  }
  return found;
}

void HexBlock::hold(int node, int axis, double displacement) {
  held_[static_cast<std::size_t>(3 * node + axis)] = 1;
  u_[3 * node + axis] = displacement;
}

void HexBlock::load(int node, const Vec3& force) { load_.segment<3>(3 * node) = force; }

HexBlock::Cell HexBlock::corners(std::size_t cell) const {
  Cell u;
  for (std::size_t a = 0; a < 8; ++a) u.col(static_cast<Eigen::Index>(a)) = displacement(corner_[cell][a]);
  return u;
}

/// Forces, and their slope by central differences.
void HexBlock::assemble() {
  force_.setZero();
  entries_.clear();
  const double d = 1e-6 * edge_.minCoeff();
  for (std::size_t c = 0; c < corner_.size(); ++c) {
    Cell u = corners(c);
    const Eigen::Matrix<double, 24, 1> f = stiffness_[c] * vector_of(forces_of(material_, k_, u));
    HexMatrix K;
    for (Eigen::Index e = 0; e < 24; ++e) {
      const double here = u.reshaped()[e];
      u.reshaped()[e] = here + d;
      K.col(e) = -vector_of(forces_of(material_, k_, u));
      u.reshaped()[e] = here - d;
      K.col(e) += vector_of(forces_of(material_, k_, u));
      u.reshaped()[e] = here;
    }
    K = (stiffness_[c] * 0.25 / d * (K + K.transpose())).eval();
    for (int a = 0; a < 24; ++a) {
      const int row = 3 * corner_[c][static_cast<std::size_t>(a / 3)] + a % 3;
      force_[row] += f[a];
      if (held_[static_cast<std::size_t>(row)] != 0) continue;
      for (int b = 0; b < 24; ++b) {
        const int column = 3 * corner_[c][static_cast<std::size_t>(b / 3)] + b % 3;
        if (held_[static_cast<std::size_t>(column)] == 0) entries_.emplace_back(row, column, K(a, b));
      }
    }
  }
}

double HexBlock::energy() const {
  double sum = 0;
  for (std::size_t c = 0; c < corner_.size(); ++c)
    sum += stiffness_[c] * forces_of(material_, k_, corners(c)).energy;
  return sum;
}

double HexBlock::potential() const { return energy() - load_.dot(u_); }

Vec3 HexBlock::force(int node) const { return force_.segment<3>(3 * node); }

double HexBlock::least_corner_J() const {
  double least = 1;
  for (std::size_t c = 0; c < corner_.size(); ++c) {
    const Cell u = corners(c);
    physics::Corners<One> w;
    for (std::size_t e = 0; e < 24; ++e) w[e % 3][e / 3] = u.reshaped()[static_cast<Eigen::Index>(e)];
    least = std::min(least, 1 + physics::least_corner_change<One>(k_, w));
  }
  return least;
}

Eigen::SparseMatrix<double> HexBlock::tangent() const {
  Eigen::SparseMatrix<double> K(u_.size(), u_.size());
  K.setFromTriplets(entries_.begin(), entries_.end());
  return K;
}

bool HexBlock::step() {
  assemble();
  Eigen::VectorXd r = force_ + load_;
  double reaction = 0;
  for (std::size_t n = 0; n < held_.size(); ++n)
    if (held_[n] != 0) {
      reaction += std::pow(r[static_cast<Eigen::Index>(n)], 2);
      r[static_cast<Eigen::Index>(n)] = 0;
      entries_.emplace_back(static_cast<int>(n), static_cast<int>(n), 1.0);
    }
  if (r.norm() <= 1e-8 * std::sqrt(reaction + load_.squaredNorm())) return true;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(tangent());
  const Eigen::VectorXd du = solver.solve(r), from = u_;
  const double before = potential(), rounding = 1e-9 * std::abs(before);
  for (double part = 1; part > 1e-3; part *= 0.5) {
    u_ = from + part * du;
    if (potential() <= before + rounding) break;
  }
  return false;
}

bool HexBlock::solve() {
  for (int n = 0; n < 60; ++n)
    if (step()) return true;
  return false;
}

}  // namespace palpate::bench
