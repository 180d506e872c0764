#pragma once
// Which nodes of a body something else can meet.

#include "physics_node/body/adjacency.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// Of a mesh a corner of an outer face, or of one that a cut has opened; else a node that is joined to fewer others than deep inside (EQUATIONS C-12), or that was a corner of a cell that broke.
class ExposedNodes {
 public:
  /// @param open_ones  also nodes that lack nothing but that space reaches, as at the bottom of a pit of the fcc surface or in
  ///   an inner corner of voxels. Deviation: in the paper a mass touches only where it lacks an element itself. Means nothing of a mesh.
  ExposedNodes(const Body& body, bool open_ones)
      : lattice_(&body.lattice), mesh_(body.mesh.get()), cells_(body.cell_net()), open_ones_(open_ones) {}

  bool contains(Index node, const Adjacency& now) const noexcept {
    if (mesh_ != nullptr && mesh_->net) return mesh_->net->is_exposed(node);
    if (mesh_ != nullptr) return mesh_->is_outer[static_cast<std::size_t>(mesh_->origin(node))] != 0;
    const Index loaded = cells_ != nullptr ? cells_->origin(node) : node;
    if (lattice_->is_beyond(loaded)) return false;
    if (cells_ != nullptr && cells_->n_copies() > 0 && cells_->is_exposed(node)) return true;
    node = loaded;
    return now.degree(node) < complete_degree(node) || (open_ones_ && lies_open(node)) || now.has_lost(node);
  }

 private:
  int complete_degree(Index node) const noexcept;
  bool lies_open(Index node) const noexcept;

  const Lattice* lattice_;
  const MeshBody* mesh_;  // null: a lattice
  const CellNet* cells_;  // of finite elements that may be cut; else null
  bool open_ones_;
};

}  // namespace palpate::physics
