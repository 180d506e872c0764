#pragma once
// The triangles of a body that something else can run into: their elements live, and they are not inside the tissue. Unlike the
// facets of a boundary they hold sheets that nothing fills.

#include <algorithm>

#include "physics_node/body/adjacency.h"
#include "physics_node/body/body.h"
#include "physics_node/lattice/triangles.h"

namespace palpate::physics {

class ExposedTriangles {
 public:
  explicit ExposedTriangles(const Body& body)
      : lattice_(&body.lattice), mesh_(body.mesh.get()), cells_(body.cell_net()) {
    if (mesh_ == nullptr) patterns_ = triangle_patterns(body.lattice);
  }

  /// There are never more on so many nodes.
  std::size_t most(std::size_t n_nodes) const noexcept {
    if (mesh_ != nullptr && mesh_->net) return 4 * static_cast<std::size_t>(mesh_->net->n_elements());
    if (mesh_ != nullptr && mesh_->triangles) return static_cast<std::size_t>(mesh_->triangles->n_elements());
    return n_nodes * std::max(most_of_a_node(), cells_ != nullptr ? most_at_cells : 0);
  }
  /// Calls take(b, c) for each whose first corner is `a`; every triangle has one first corner.
  /// @param wanted  called with another corner: false leaves the triangle out
  template <class Wanted, class Take>
  void each(Index a, const Adjacency& now, const Wanted& wanted, const Take& take) const noexcept {
    if (mesh_ != nullptr && mesh_->net) return each_of_net(a, wanted, take);
    if (mesh_ != nullptr && mesh_->triangles) return each_of_surface(a, wanted, take);
    if (mesh_ != nullptr) return each_of_mesh(a, wanted, take);
    if (now.is_at_cut(a)) return each_of_cells(a, wanted, take);
    const auto live = [&](Index node) { return now.live_elements(node); };
    for (const TrianglePattern& triangle : patterns_[static_cast<std::size_t>(lattice_->row_kind(a))]) {
      if (!holds(triangle.edges[0], a, live)) continue;
      const Index b = a + triangle.corner[0], c = a + triangle.corner[1];
      if (!wanted(b) || !wanted(c)) continue;
      // Three elements that other cells hold are no sheet where these live as a whole.
      if (lattice_->has_cells ? is_boundary(triangle, a, live) : is_exposed(triangle, a, live)) take(b, c);
    }
  }

 private:
  static constexpr std::size_t most_at_cells = 48;  // of eight cells, three faces of two triangles

  std::size_t most_of_a_node() const noexcept {
    std::size_t most = 0;
    if (mesh_ != nullptr)
      for (const Index node : mesh_->nodes) most = std::max(most, mesh_->faces_of_first.of(node).size());
    for (const auto& patterns : patterns_) most = std::max(most, patterns.size());
    return most;
  }
  /// The first corner is that with the smallest number.
  template <class Wanted, class Take>
  void each_of_net(Index a, const Wanted& wanted, const Take& take) const noexcept {
    const TetNet& net = *mesh_->net;
    net.each_corner(a, [&](Index tet, std::size_t) {
      for (std::size_t f = 0; f < 4; ++f) {
        MeshTriangle face = net.face(tet, f);
        std::rotate(face.begin(), std::ranges::min_element(face), face.end());
        if (face[0] == a && net.is_exposed(tet, f) && wanted(face[1]) && wanted(face[2]))
          take(face[1], face[2]);
      }
    });
  }
  template <class Wanted, class Take>
  void each_of_surface(Index a, const Wanted& wanted, const Take& take) const noexcept {
    const TriangleNet& net = *mesh_->triangles;
    net.each_corner(a, [&](Index triangle, std::size_t) {
      MeshTriangle face = net.corners(triangle);
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
      if (face[0] == a && wanted(face[1]) && wanted(face[2])) take(face[1], face[2]);
    });
  }
  /// Where a cut has parted cells: both halves of their faces.
  template <class Wanted, class Take>
  void each_of_cells(Index a, const Wanted& wanted, const Take& take) const noexcept {
    cells_->each_corner(a, [&](Index cell, std::size_t) {
      for (std::size_t f = 0; f < CellNet::n_faces; ++f) {
        CellNet::Face face = cells_->face(cell, f);
        std::rotate(face.begin(), std::ranges::min_element(face), face.end());
        if (face[0] != a || !cells_->is_exposed(cell, f) || !wanted(face[2])) continue;
        if (wanted(face[1])) take(face[1], face[2]);
        if (wanted(face[3])) take(face[2], face[3]);
      }
    });
  }
  template <class Wanted, class Take>
  void each_of_mesh(Index a, const Wanted& wanted, const Take& take) const noexcept {
    for (const Index f : mesh_->faces_of_first.of(a)) {
      const MeshTriangle& face = mesh_->faces[static_cast<std::size_t>(f)];
      if (wanted(face[1]) && wanted(face[2])) take(face[1], face[2]);
    }
  }

  const Lattice* lattice_;
  const MeshBody* mesh_;  // null: a lattice
  const CellNet* cells_;  // of finite elements that may be cut; else null
  TrianglePatterns patterns_;
};

}  // namespace palpate::physics
