#pragma once
// Who carries the vertices of a smooth skin while its body breaks or is cut. Where the cell goes that carried one, the next
// that lives around its corner takes it on, at the same place of the body at rest. Where a cut parts a node, it and each of its
// copies have such a vertex of their own, carried by a cell on their own side; and inside, corners of a lip (cut_lips.h).

#include <optional>
#include <span>

#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/cut_lips.h"
#include "physics_node/boundary/smooth_skin.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/step/topology.h"

namespace palpate::physics {

class LiveSkin {
 public:
  /// @param moving, as_loaded  outlive it
  LiveSkin(const Topology& moving, const Surface& as_loaded);

  const Bearers& bearers(std::uint32_t vertex) const noexcept { return now_[vertex]; }
  /// The vertex that facets have which open at this mass; none: the mass itself is their corner.
  std::optional<std::uint32_t> vertex_of(Index mass) const noexcept {
    const std::uint32_t vertex = first_[static_cast<std::size_t>(mass)];
    return vertex == none ? std::nullopt : std::optional(vertex);
  }

  /// The corner of a lip of a cut, at a node or a copy of it: where it rests, and who carries it.
  struct Lip {
    Vec3 rest = Vec3::Zero();  // [m]
    Bearers by;
    Vec3 position(const NodeMotion& moving) const noexcept { return rest + by.displacement(moving); }
  };
  /// null: it is none
  const Lip* lip(Index node) const noexcept {
    if (lip_of_.empty() || lip_of_[static_cast<std::size_t>(node)] < 0) return nullptr;
    return &lips_[static_cast<std::size_t>(lip_of_[static_cast<std::size_t>(node)])];
  }

  /// As loaded, whatever is gone. Allocates nothing.
  void restart() noexcept;
  /// A cell has changed. Allocates nothing. Cost: its eight corners, 64 cells.
  void look_at(const Vec3i& cell) noexcept;

 private:
  CellsRound cells_round(Index node) const noexcept;
  void look_at_cut(const Vec3i& corner, Index mass) noexcept;
  void put_lip(const Vec3i& corner, Index node) noexcept;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  const Body& body_;
  const Surface& as_loaded_;
  SmoothSkin skin_;
  CellsNow cells_;
  std::vector<Bearers> now_;          // (n_moving)
  std::vector<std::uint32_t> first_;  // vertex of each mass, that of its first fan  (n_cells of the lattice)
  std::vector<std::uint32_t> next_;   // of the same mass  (n_moving)
  std::vector<std::int32_t> lip_of_;  // of a node or copy, in lips_; -1: none. EMPTY: nothing is cut
  std::vector<Lip> lips_;
};

}  // namespace palpate::physics
