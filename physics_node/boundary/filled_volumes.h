#pragma once
// The volumes that a body fills now, as tetrahedra: what it takes to know whether a place is inside it. What broke open has no
// inside.

#include <algorithm>
#include <array>

#include "physics_node/body/build_lattice.h"
#include "physics_node/lattice/volumes.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

class FilledVolumes {
 public:
  /// @param moving  outlives this
  explicit FilledVolumes(const BodyModel& moving) : moving_(&moving) {
    const Body& body = moving.body();
    if (!body.mesh) patterns_ = volume_patterns(body.lattice);
    if (body.cells) shift_ = lattice_corner(*body.cells, body.lattice);
  }

  /// Calls take(corners) for each tetrahedron of the volumes whose first corner is this node as loaded: where its corners are now.
  template <class Take>
  void each(Index node, const Take& take) const noexcept {
    const Body& body = moving_->body();
    if (body.mesh && body.mesh->net) {
      const TetNet& net = *body.mesh->net;
      net.each_around(node, [&](Index tet, std::size_t corner) {
        if (corner != 0) return;
        const auto& corners = net.corners(tet);
        take(std::array<Vec3, 4>{moving_->position(corners[0]), moving_->position(corners[1]),
                                 moving_->position(corners[2]), moving_->position(corners[3])});
      });
      return;
    }
    if (body.mesh) {
      for (const Index t : body.mesh->filled_of_first.of(node)) {
        const auto& corners = body.mesh->filled[static_cast<std::size_t>(t)];
        take(std::array<Vec3, 4>{moving_->position(corners[0]), moving_->position(corners[1]),
                                 moving_->position(corners[2]), moving_->position(corners[3])});
      }
      return;
    }
    const Lattice& lattice = body.lattice;
    const auto live = [&](Index n) { return moving_->adjacency().live_elements(n); };
    for (const VolumePattern& volume : patterns_[static_cast<std::size_t>(lattice.row_kind(node))]) {
      if (!is_filled(volume, lattice, node, live)) continue;
      if (body.cells) {  // elements of the cells beside it may close a volume in an empty cell
        const Vec3i at = shift_ + lattice.grid_of(node) + volume.lowest;
        if (!body.cells->is_deformable(at.x(), at.y(), at.z())) continue;
      }
      std::array<Vec3, 6> x;
      const Index cell = body.cells ? lattice.cell_of(lattice.grid_of(node) + volume.lowest) : 0;
      for (std::size_t c = 0; c < volume.corner.size(); ++c)
        x[c] = moving_->position(now_at(body, cell, node + volume.corner[c]));
      for (const auto& t : volume.tetrahedra) take(std::array<Vec3, 4>{x[t[0]], x[t[1]], x[t[2]], x[t[3]]});
    }
  }

 private:
  /// A corner of a cell, which a cut may have given a copy.
  static Index now_at(const Body& body, Index cell, Index corner) noexcept {
    const CellNet* net = body.cell_net();
    if (net == nullptr || !net->is_parted(cell)) return corner;
    const CellNet::Corners loaded = net->loaded_corners(cell);
    const auto k = static_cast<std::size_t>(std::ranges::find(loaded, corner) - loaded.begin());
    return k < loaded.size() ? net->corners(cell)[k] : corner;
  }

  const BodyModel* moving_;
  VolumePatterns patterns_;
  Vec3i shift_ = Vec3i::Zero();  // from grid coordinates to cells, of voxels
};

}  // namespace palpate::physics
