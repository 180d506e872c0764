// How a surface of springs takes the copies of nodes that a cut makes (mesh/simplex_net.h).
//
// A triangle keeps its own share of every spring at its sides, so where two part there are two springs in the place of
// one, which together are as stiff and hold as much: EQUATIONS C-26. A node weighs a third of the triangles that are
// still at it, C-24.

#include <algorithm>

#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/surface_mesh/surface_springs.h"

namespace palpate::physics {
namespace {

bool have_the_same(const TriangleNet::Face& a, const TriangleNet::Face& b) noexcept {
  return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]);
}

}  // namespace

template <class Real>
void SurfaceSprings<Real>::prepare_for_cuts(const SpringSurface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  joints_.spring_of.resize(3 * mesh.triangles.size());
  const std::vector<MeshEdge> edges = edges_of(mesh);  // in the order of the springs
  for (std::size_t s = 0; s < edges.size(); ++s)
    for (const Index t : edges[s].triangle)
      for (std::size_t side = 0; side < 3; ++side) {
        const MeshTriangle& of = mesh.triangles[static_cast<std::size_t>(t)];
        if (have_the_same({of[side], of[(side + 1) % 3]}, edges[s].node))
          joints_.spring_of[3 * static_cast<std::size_t>(t) + side] = static_cast<Index>(s);
      }
  for (const MeshTriangle& corners : mesh.triangles) area_at_rest_.push_back(area_of(mesh, corners));
  std::size_t most = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n)
    most = std::max(most, joints_.around_node[n].end - joints_.around_node[n].begin);
  copied_.reserve(most);
  wanted_.assign(n_nodes(), 0);
  loaded_ = joints_;
}

/// The two sides of an edge have other nodes than each other: each triangle gets a spring of its own share.
template <class Real>
void SurfaceSprings<Real>::part_spring(std::size_t triangle, std::size_t side,
                                       const TriangleNet& net) noexcept {
  const Index neighbour = net.beyond(static_cast<Index>(triangle), side);
  const std::size_t other = static_cast<std::size_t>(neighbour),
                    theirs = net.face_between(neighbour, static_cast<Index>(triangle));
  Index& mine = joints_.spring_of[3 * triangle + side];
  Index& of_other = joints_.spring_of[3 * other + theirs];
  const bool parts =
      !have_the_same(net.face(static_cast<Index>(triangle), side), net.face(neighbour, theirs));
  if (parts && mine == of_other) {
    of_other = static_cast<Index>(joints_.springs.size());
    joints_.springs.push_back(joints_.springs[static_cast<std::size_t>(mine)]);
    for (const auto& [t, spring] : {std::pair{triangle, mine}, std::pair{other, of_other}}) {
      Spring& one = joints_.springs[static_cast<std::size_t>(spring)];
      one.k = static_cast<Real>(spring_share(membrane_, area_at_rest_[t], static_cast<double>(one.length)));
    }
  }
  Spring& spring = joints_.springs[static_cast<std::size_t>(mine)];
  for (Index& end : spring.node)
    for (const Index node : net.face(static_cast<Index>(triangle), side))
      if (net.origin(node) == net.origin(end)) {
        end = node;
        break;
      }
}

/// Of all that was one node when it was loaded: whose springs and triangles are whose. They share the room of that node.
template <class Real>
void SurfaceSprings<Real>::list_anew(Index origin, const TriangleNet& net) noexcept {
  const auto first = static_cast<std::size_t>(origin);
  std::size_t at = loaded_.of_node[first].begin, around_at = loaded_.around_node[first].begin;
  copied_.clear();
  net.each_around(origin, [&](Index t, std::size_t corner) {
    const Index node = net.corners(t)[corner];
    if (std::ranges::find(copied_, node) == copied_.end()) copied_.push_back(node);
  });
  for (const Index node : copied_) {
    const auto n = static_cast<std::size_t>(node);
    Range &of = joints_.of_node[n], &around = joints_.around_node[n];
    of.begin = of.end = at, around.begin = around.end = around_at;
    net.each_corner(node, [&](Index t, std::size_t corner) {
      const MeshTriangle& corners = net.corners(t);
      joints_.around[around.end++] = {t, {corners[(corner + 1) % 3], corners[(corner + 2) % 3]}};
      for (const std::size_t side : {corner, (corner + 2) % 3}) {
        const Index spring = joints_.spring_of[3 * static_cast<std::size_t>(t) + side];
        bool is_new = true;
        for (std::size_t i = of.begin; i < of.end; ++i)
          is_new = is_new && joints_.incident[i].spring != spring;
        if (!is_new) continue;
        const bool begins = joints_.springs[static_cast<std::size_t>(spring)].node[0] == node;
        joints_.incident[of.end++] = {begins ? 1.0 : -1.0, spring};
      }
    });
    at = of.end, around_at = around.end;
    const double mass = mass_at(n);
    inverse_mass_[n] = inverse_mass_[first] > 0 ? 1 / mass : 0;
    drag_[n] = membrane_.drag * mass;
  }
  // Drag as mass, all of it what the node had.
  double whole = 0;
  for (const Index node : copied_) whole += drag_[static_cast<std::size_t>(node)];
  if (whole > 0)
    for (const Index node : copied_) drag_[static_cast<std::size_t>(node)] *= membrane_.drag / whole;
}

template <class Real>
double SurfaceSprings<Real>::mass_at(std::size_t node) const noexcept {
  double sum = 0;
  for (std::size_t t = joints_.around_node[node].begin; t < joints_.around_node[node].end; ++t)
    sum += mass_share(membrane_, area_at_rest_[static_cast<std::size_t>(joints_.around[t].triangle)]);
  return sum;
}

template <class Real>
double SurfaceSprings<Real>::separate(std::span<const NodeSplit> splits, const TriangleNet& net) noexcept {
  if (splits.empty()) return 0;
  double grown = 0;
  if (is_filled()) {  // it flows out at once, and what it held by its pressure is gone
    look_at_volume({});
    const double more = volume_ - rest_volume_;
    grown += given_by_pressure() - 0.5 * membrane_.content_modulus * more * more / rest_volume_;
    leaks_ = true;
  }
  for (const auto& [node, copy] : splits) {
    const auto from = static_cast<std::size_t>(node), to = static_cast<std::size_t>(copy);
    rest_.push_back(rest_[from]);
    inverse_mass_[to] = inverse_mass_[from];
    set_vector(u_, to, displacement(node));
    set_vector(v_, to, velocity(node));
    damping_before_[to].setZero();  // its part is with the node, which is as fast
  }
  std::ranges::fill(wanted_, std::uint8_t{0});
  const auto each_triangle = [&](const auto& visit) {
    for (const NodeSplit& split : splits)
      net.each_around(split.node, [&](Index t, std::size_t) { visit(static_cast<std::size_t>(t)); });
  };
  each_triangle([&](std::size_t t) {
    joints_.triangles[t] = net.corners(static_cast<Index>(t));
    for (std::size_t side = 0; side < 3; ++side) part_spring(t, side, net);
    for (const Index node : joints_.triangles[t]) wanted_[static_cast<std::size_t>(net.origin(node))] = 1;
  });
  each_triangle([&](std::size_t t) {
    for (const Index node : joints_.triangles[t]) {
      const Index origin = net.origin(node);
      if (wanted_[static_cast<std::size_t>(origin)] == 0) continue;
      wanted_[static_cast<std::size_t>(origin)] = 0;
      list_anew(origin, net);
    }
  });
  return grown;
}

template <class Real>
void SurfaceSprings<Real>::copy_saved(Saved& saved, Index node, Index copy) const noexcept {
  std::copy_n(saved.u.data() + 4 * static_cast<std::size_t>(node), 4,
              saved.u.data() + 4 * static_cast<std::size_t>(copy));
}

template <class Real>
void SurfaceSprings<Real>::rejoin() noexcept {
  if (loaded_.spring_of.empty()) return;
  joints_ = loaded_;  // which has room for it
  rest_.resize(wanted_.size());
  std::ranges::fill(elastic_, 0.0);
  std::ranges::fill(ledger_, Ledger{});
  leaks_ = false;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    drag_[n] = membrane_.drag;
    if (inverse_mass_[n] > 0) inverse_mass_[n] = 1 / mass_at(n);
  }
}

#define PALPATE_SURFACE_SEPARATION_OF(Real)                                                                \
  template void SurfaceSprings<Real>::prepare_for_cuts(const SpringSurface&);                              \
  template double SurfaceSprings<Real>::separate(std::span<const NodeSplit>, const TriangleNet&) noexcept; \
  template void SurfaceSprings<Real>::copy_saved(Saved&, Index, Index) const noexcept;                     \
  template void SurfaceSprings<Real>::rejoin() noexcept;                                                   \
  template double SurfaceSprings<Real>::mass_at(std::size_t) const noexcept;

PALPATE_SURFACE_SEPARATION_OF(float)
PALPATE_SURFACE_SEPARATION_OF(double)

#undef PALPATE_SURFACE_SEPARATION_OF

}  // namespace palpate::physics
