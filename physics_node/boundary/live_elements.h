#pragma once
// The live elements of a body at one moment, apart from the body: a thread of its own may make a surface from them while
// the body moves on.

#include <array>
#include <span>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/step/topology.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

/// Of a mesh that may be cut it holds the faces that can be touched, of a surface all triangles; of another, in which
/// nothing breaks, nothing. Of cells that may be cut also those that have been.
class LiveElements {
 public:
  /// Those alive now.
  explicit LiveElements(const Topology& moving);
  /// None alive.
  explicit LiveElements(const Body& body);
  void copy(const Topology& moving);
  void copy(const Body& body, const Adjacency& from);
  /// Of all nodes, in their order, as a record holds them.
  void copy(const Body& body, std::span<const Mask> recorded);

  /// Bit d: the element in direction d lives.
  Mask mask(Index cell) const { return mask_[static_cast<std::size_t>(cell)]; }
  std::span<const Mask> masks() const { return {mask_.data(), mask_.size()}; }  // (n_cells)
  struct Face {
    Index element = 0;
    bool is_skin = true;                // as loaded; else a cut has opened it, or of a surface goes along it
    MeshTriangle corners{}, origins{};  // origins: the nodes as loaded that these are, or are copies of
  };
  std::span<const Face> faces() const { return faces_; }  // in the order of the elements

  /// A cell of finite elements that has a copy at a corner, or an open face.
  struct PartedCell {
    Index cell = 0;  // its lowest corner, in storage
    CellNet::Corners corners{};
    std::uint8_t open = 0;            // bit f: its face f can be touched, and another cell lay behind it
    std::array<FaceCut, 3> cut_at{};  // by axis, as CellNet has it
  };
  std::span<const PartedCell> parted() const { return parted_; }  // by `cell`
  const PartedCell* parted(Index cell) const noexcept;            // null: it is as loaded

 private:
  void copy_faces(const Body& body);
  void copy_triangles(const TriangleNet& net);
  void copy_parted(const Body& body);

  ZeroedArray<Mask> mask_;  // (n_cells)
  std::vector<Face> faces_;
  std::vector<PartedCell> parted_;
};

/// Answers about masses and elements by grid coordinate.
class LiveNet {
 public:
  /// @param masks  of all storage cells; both outlive this  (n_cells)
  LiveNet(const Lattice& lattice, std::span<const Mask> masks);

  /// Storage cell of the mass there, -1 where there is none.
  Index mass(const Vec3i& grid) const { return lattice_.mass_at(grid); }
  Mask mask(Index cell) const { return masks_[static_cast<std::size_t>(cell)]; }
  /// Has this mass lost an element?
  bool has_lost(Index cell) const { return mask(cell) != lattice_.mask[static_cast<std::size_t>(cell)]; }
  /// Is the element from a mass with this mask to the place that differs by `delta` alive?
  bool alive(Mask mask, const Vec3i& delta) const {
    const int d = direction_[key(delta)];
    return d >= 0 && (mask >> d & 1) != 0;
  }
  /// Does a live element join two grid points, each of whose coordinates differ by at most one?
  bool joined(const Vec3i& a, const Vec3i& b) const;

 private:
  static std::size_t key(const Vec3i& delta) {
    return static_cast<std::size_t>((delta.x() + 1) + 3 * (delta.y() + 1) + 9 * (delta.z() + 1));
  }
  const Lattice& lattice_;
  std::span<const Mask> masks_;
  std::array<int, 27> direction_;  // by difference of the coordinates; -1: no direction of this lattice
};

/// Differences of grid coordinates to the neighbours, by direction.  (2 n_half)
std::vector<Vec3i> all_directions(LatticeKind kind);

}  // namespace palpate::physics
