#pragma once
// The constant part of a lattice body: where its masses rest and which elements join them.
//
// Masses sit in a box-shaped grid of storage cells with a halo of empty cells around it, in rows along x. The
// stencil is regular, so a neighbour is at a constant offset and there are no index lists: an element is a bit in
// its masses' masks, a row of masses is a run of consecutive cells, and only runs with material are ever visited.
//
//   fcc    12 neighbours, 6 half directions (EQUATIONS C-12). Grid coordinates (X, Y, Z) with X + Y + Z even, in
//          steps of L / sqrt(2) along the cubic axes; X is stored at i = (X - parity) / 2 with parity = (Y + Z) & 1, so
//          the offsets are constant within a row and of two kinds.
//   voxel  the edges of five tetrahedra per cell, mirrored from cell to cell (EQUATIONS C-38): 3 half directions
//          along the axes, 6 along the diagonals of the faces. A face has the one diagonal that joins its corners of
//          even X + Y + Z, so the cells on both sides agree on it and the mesh conforms: an even mass has up to 18
//          neighbours, an odd one 6. An element exists where a filled cell holds it. Each row is stored as two, the masses
//          of even X before those of odd X, so that the masses of a row all have the same neighbours and no vector of
//          masses carries idle lanes: four kinds of row.
//
// No row has two neighbours in it, and every element is stepped from the end that comes first in storage.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/kinds.h"
#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

using Vec3i = Eigen::Vector3i;

/// mass_share of a mass that only cells which are not seen have at a corner.
inline constexpr float share_beyond = 1.0F / 1024;

struct Lattice {
  LatticeKind kind = LatticeKind::fcc;
  int n_half = 6;              // half directions; direction d + n_half is opposite to d
  Vec3i size = Vec3i::Zero();  // storage cells along x, y, z, halo included
  Index pitch = 0;             // storage cells from a row to the next along y
  Vec3 origin = Vec3::Zero();  // rest position of grid coordinate (0, 0, 0) [m]
  Vec3 step = Vec3::Zero();    // of a grid coordinate [m]
  /// R_WL: its columns are the axes of the grid in the world. Only fcc lattices turn.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  std::array<std::array<Index, max_directions>, max_row_kinds> offset{};  // to the neighbour, by row kind
  /// Directions in which a mass can have elements and is the first of the two in storage, by row kind.
  std::array<std::vector<int>, max_row_kinds> forward{};
  std::array<Vec3, max_directions> rest_vector{};    // to the neighbour at rest [m]
  std::array<double, max_directions> rest_length{};  // L [m]

  std::vector<RowSegment> rows;  // in storage order
  std::vector<Chunk> chunks;     // of rows, in order
  std::vector<Index> masses;     // storage cell of each mass, in storage order  (n_masses)
  std::vector<Mask> mask;        // elements of each storage cell at the start   (n_cells)
  bool has_cells = false;  // masks hold cell_bits: an element lives while one of the cells that hold it does
  std::vector<float>
      mass_share;  // mass of each storage cell in units of a seen cell's, 0 where empty        (n_cells)

  Index n_cells() const { return pitch * size.y() * size.z(); }
  Index n_masses() const { return static_cast<Index>(masses.size()); }
  /// Is a mass at the corners of cells only that are not seen? It moves with the others and nobody touches it.
  bool is_beyond(Index cell) const { return mass_share[static_cast<std::size_t>(cell)] <= share_beyond; }
  std::int64_t n_elements() const;
  double total_share() const;  // sum of mass_share: the body's volume in cells (voxel) or masses (fcc)

  /// Storage cell of a grid coordinate, which must lie within the box (halo included).
  Index cell_of(const Vec3i& grid) const;
  Vec3i grid_of(Index cell) const;
  /// The storage cell of the mass at a grid coordinate, or -1 where there is none. Any coordinate may be asked.
  Index mass_at(const Vec3i& grid) const;
  Vec3 rest_position(Index cell) const {
    return origin + axes * step.cwiseProduct(grid_of(cell).cast<double>());
  }
  /// L of fcc; of voxels the longest edge of a cell [m].
  double spacing() const { return kind == LatticeKind::fcc ? rest_length[0] : step.maxCoeff(); }
  int row_kind(Index cell) const;
  /// The row that holds a mass: the last that begins at or before it.
  Index row_of(Index cell) const;
  /// Does direction d lead to the next plane of z?
  bool leads_up(int d) const;
};

/// Lowest and highest grid coordinates of the cells of a voxel lattice that reach into a box, within the lattice.
struct GridBox {
  Vec3i low, high;
};
GridBox grid_box(const Lattice& lattice, const Vec3& low, const Vec3& high);

/// Half directions of a lattice in grid coordinates.
std::vector<Vec3i> half_directions(LatticeKind kind);

/// Elements of a half direction per mass, deep inside: 1, or 1/2 for the face diagonals of voxels.
double elements_per_mass(LatticeKind kind, std::size_t half_direction);

/// An empty lattice whose box holds the grid coordinates [0, extent) and a halo. `origin`, `step`, `axes` as above.
Lattice make_lattice(LatticeKind kind, const Vec3i& extent, const Vec3& origin, const Vec3& step,
                     const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());

/// Storage cells of the widest vector of floats.
inline constexpr Index row_segment = 16;

enum class Rows { whole, in_segments };  // of row_segment storage cells, which may act or rest on their own

/// Fills rows, chunks and masses from mass_share > 0.
void index_masses(Lattice& lattice, Rows rows = Rows::whole);

}  // namespace palpate::physics
