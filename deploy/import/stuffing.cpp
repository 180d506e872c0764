#include "deploy/import/stuffing.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "deploy/import/tet_cut.h"

namespace palpate {
namespace {

using physics::Index;

// How near to its end a crossing moves that, in shares of the edge: the two that give the paper's best bound.
constexpr double alpha_long = 0.24999, alpha_short = 0.41189;
constexpr int halvings = 30;  // of an edge, to its crossing

/// Points: the corners of cubes, and after them the middles.
class Lattice {
 public:
  explicit Lattice(const StuffingLattice& spec) : edge_(spec.edge) {
    // Two more on either side, so that all points of an edge that is crossed are there.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      low_[axis] = spec.low[axis] - (2 + spec.shift[axis]) * edge_;
      n_[static_cast<std::size_t>(axis)] =
          static_cast<std::int64_t>(std::ceil((spec.high[axis] - low_[axis]) / edge_)) + 3;
    }
    corners_ = n_[0] * n_[1] * n_[2];
  }
  std::int64_t size() const noexcept { return 2 * corners_; }
  double edge() const noexcept { return edge_; }
  bool is_middle(std::int64_t p) const noexcept { return p >= corners_; }
  std::array<std::int64_t, 3> cube_of(std::int64_t p) const noexcept {
    const std::int64_t c = is_middle(p) ? p - corners_ : p;
    return {c % n_[0], c / n_[0] % n_[1], c / (n_[0] * n_[1])};
  }
  /// -1: beyond the lattice
  std::int64_t point(bool middle, const std::array<std::int64_t, 3>& cube) const noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (cube[axis] < 0 || cube[axis] >= n_[axis]) return -1;
    return (middle ? corners_ : 0) + cube[0] + n_[0] * (cube[1] + n_[1] * cube[2]);
  }
  Vec3 place(std::int64_t p) const noexcept {
    const auto cube = cube_of(p);
    const double half = is_middle(p) ? 0.5 : 0.0;
    return low_ + edge_ * Vec3(static_cast<double>(cube[0]) + half, static_cast<double>(cube[1]) + half,
                               static_cast<double>(cube[2]) + half);
  }
  /// Six at an edge's length, then eight nearer.
  std::array<std::int64_t, 14> neighbours(std::int64_t p) const noexcept {
    std::array<std::int64_t, 14> all{};
    const auto cube = cube_of(p);
    const bool middle = is_middle(p);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t up = 0; up < 2; ++up) {
        auto other = cube;
        other[axis] += up == 1 ? 1 : -1;
        all[2 * axis + up] = point(middle, other);
      }
    for (std::size_t corner = 0; corner < 8; ++corner) {
      auto other = cube;
      for (std::size_t axis = 0; axis < 3; ++axis)
        other[axis] += static_cast<std::int64_t>(corner >> axis & 1) - (middle ? 0 : 1);
      all[6 + corner] = point(!middle, other);
    }
    return all;
  }
  /// Calls use(tetrahedron of points): four round each edge between corners.
  template <class Use>
  void for_each_tet(const Use& use) const {
    for (std::int64_t p = 0; p < corners_; ++p) {
      const auto cube = cube_of(p);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto end = cube;
        ++end[axis];
        const std::int64_t q = point(false, end);
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        std::array<std::int64_t, 4> ring{};  // middles round the edge
        for (std::size_t n = 0; n < 4; ++n) {
          auto middle = cube;
          middle[b] -= n == 1 || n == 2 ? 1 : 0;
          middle[c] -= n >= 2 ? 1 : 0;
          ring[n] = point(true, middle);
        }
        for (std::size_t n = 0; n < 4; ++n) {
          const std::array<std::int64_t, 4> tet{p, q, ring[n], ring[(n + 1) % 4]};
          if (*std::ranges::min_element(tet) >= 0) use(tet);
        }
      }
    }
  }

 private:
  double edge_;
  Vec3 low_ = Vec3::Zero();
  std::array<std::int64_t, 3> n_{};
  std::int64_t corners_ = 0;
};

class Stuffing {
 public:
  using Point = std::int64_t;

  Stuffing(const StuffingLattice& spec, const std::function<double(const Vec3&)>& inside)
      : lattice_(spec), inside_(inside) {
    sign_.resize(static_cast<std::size_t>(lattice_.size()));
    for (std::int64_t p = 0; p < lattice_.size(); ++p)
      sign(p) = inside_(lattice_.place(p)) > 0 ? std::int8_t{1} : std::int8_t{-1};
  }

  physics::TetMesh fill() {
    for (std::int64_t p = 0; p < lattice_.size(); ++p) snap(p);
    TetCut<Stuffing> cut(*this, true);
    lattice_.for_each_tet([&](const std::array<std::int64_t, 4>& points) { cut.cut(points); });
    mesh_.region.assign(mesh_.tets.size(), 0);
    physics::tidy(mesh_);
    return std::move(mesh_);
  }

  // What TetCut asks for.
  std::int8_t& sign(std::int64_t p) noexcept { return sign_[static_cast<std::size_t>(p)]; }
  Index node(std::int64_t p) {
    const auto found = node_of_.find(p);
    if (found != node_of_.end()) return found->second;
    const auto moved = moved_.find(p);
    return node_of_[p] = add(moved != moved_.end() ? moved->second : lattice_.place(p));
  }
  Index node(std::int64_t p, std::int64_t q) {
    const std::int64_t edge = std::min(p, q) * lattice_.size() + std::max(p, q);
    const auto found = node_on_.find(edge);
    return found != node_on_.end() ? found->second : node_on_[edge] = add(crossing(p, q));
  }
  physics::TetMesh& mesh() noexcept { return mesh_; }

 private:
  /// Where the field crosses the edge, whose ends are on different sides; from the same end whoever asks.
  Vec3 crossing(std::int64_t p, std::int64_t q) const {
    if (sign_[static_cast<std::size_t>(p)] < sign_[static_cast<std::size_t>(q)]) std::swap(p, q);
    Vec3 in = lattice_.place(p), out = lattice_.place(q);
    for (int n = 0; n < halvings; ++n) {
      const Vec3 middle = 0.5 * (in + out);
      (inside_(middle) > 0 ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  /// Moves a point onto the nearest crossing that is too near to it.
  void snap(std::int64_t p) {
    const auto neighbours = lattice_.neighbours(p);
    const Vec3 place = lattice_.place(p);
    double nearest = lattice_.edge();
    Vec3 onto = place;
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      const std::int64_t q = neighbours[n];
      if (q < 0 || sign(p) * sign(q) >= 0) continue;
      const Vec3 at = crossing(p, q);
      const double far = (at - place).norm(), length = (lattice_.place(q) - place).norm();
      if (far < (n < 6 ? alpha_long : alpha_short) * length && far < nearest) nearest = far, onto = at;
    }
    if (nearest >= lattice_.edge()) return;
    sign(p) = 0;
    moved_.emplace(p, onto);
  }

  Index add(const Vec3& x) {
    mesh_.nodes.push_back(x);
    return static_cast<Index>(mesh_.nodes.size() - 1);
  }

  Lattice lattice_;
  const std::function<double(const Vec3&)>& inside_;
  std::vector<std::int8_t> sign_;  // of each point: 1 inside, -1 outside, 0 on the surface
  std::unordered_map<std::int64_t, Vec3> moved_;
  std::unordered_map<std::int64_t, Index> node_of_, node_on_;  // of a point; of an edge
  physics::TetMesh mesh_;
};

}  // namespace

double points_of(const StuffingLattice& lattice) noexcept {
  double n = 2;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    n *= std::ceil((lattice.high[axis] - lattice.low[axis]) / lattice.edge) + 6;
  return n;
}

physics::TetMesh stuff(const StuffingLattice& lattice, const std::function<double(const Vec3&)>& inside) {
  return Stuffing(lattice, inside).fill();
}

}  // namespace palpate
