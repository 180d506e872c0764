#pragma once
// What a body has that is a mesh, in the place of a lattice: of tetrahedra, or a closed surface of springs.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics_node/body/spring_surface.h"
#include "physics_node/body/tet_model.h"
#include "physics_node/mesh/simplex_net.h"

namespace palpate::physics {

/// Its nodes are numbered from 0 on. It never changes after loading, but where it has a net: then that says how its
/// tetrahedra or triangles hang together now, `mass` is as now, and all the rest is as loaded. Only who steps it changes these.
struct MeshBody {
  TetModel model;  // renumbered; where its nodes rest in the world, what it is made of, what is held
  std::optional<SpringSurface> springs;       // the model then has nodes alone
  std::vector<Index> nodes;                   // 0, 1, 2 ...
  std::vector<double> mass;                   // of each node, and room for those of copies [kg]
  NodeLists neighbours;                       // of each node
  std::vector<MeshTriangle> faces;            // outer ones, by first corner
  std::vector<std::array<Index, 4>> filled;   // the tetrahedra that it fills, by first corner
  NodeLists faces_of_first, filled_of_first;  // by first corner: numbers of the two
  std::vector<std::uint8_t> is_outer;         // of each node: a corner of a face
  double spacing = 0;                         // mean edge of its faces [m]
  double longest_edge = 0;                    // of an element [m]
  Tidied tidied;                              // what the reader had to mend
  std::unique_ptr<TetNet> net;                // of tetrahedra that may be cut; else null
  std::unique_ptr<TriangleNet> triangles;     // of a surface of springs that may be cut; else null

  /// Where a node rests, or the one that it is a copy of [m].
  const Vec3& rest(Index node) const noexcept {
    return model.mesh.nodes[static_cast<std::size_t>(origin(node))];
  }
  /// Of what may be cut; else null.
  const NodeCopies* copies() const noexcept {
    return net ? static_cast<const NodeCopies*>(net.get()) : triangles.get();
  }
  Index origin(Index node) const noexcept { return copies() != nullptr ? copies()->origin(node) : node; }
  std::size_t most_copies() const noexcept { return copies() != nullptr ? copies()->most_copies() : 0; }
  /// Tetrahedra, or springs.
  std::int64_t n_elements() const noexcept {
    return static_cast<std::int64_t>(springs ? springs->springs.size() : model.mesh.tets.size());
  }
};

/// Fills all of it but `tidied` from a model. @param model  renumbered; no face of it is of more than two tetrahedra
MeshBody mesh_body(TetModel model);
/// The same of a surface, which fills nothing.
MeshBody mesh_body(SpringSurface surface);

}  // namespace palpate::physics
