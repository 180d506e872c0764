#pragma once
// Tetrahedra in the order in which a step meets them: blocks of some hundred that one thread takes at a time.
//
// A block copies its nodes, computes its tetrahedra sixteen at a time, and sums what they do to its nodes in a part of its own. Then
// each node sums its parts. Both orders depend on the mesh alone, so that every sum is the same on any number of threads and by
// vectors of any width, and what a tetrahedron does to its corners never leaves the first-level cache.

#include <cstdint>

#include "physics_node/body/tet_model.h"

namespace palpate::physics {

inline constexpr std::size_t tet_lanes = 16;
inline constexpr std::size_t most_block_tets = 1024;
/// Why: with its copy and its part, 24 KiB in single precision. A good order needs 300.
inline constexpr std::size_t most_block_nodes = 768;

/// Of TetBatch::corner for each node of the block.
template <class Real>
inline constexpr std::size_t corner_step = 4 * sizeof(Real) / 8;

/// Sixteen tetrahedra side by side. Lanes that are left over have no volume and no slopes, and act on a node of the block.
template <class Real, std::size_t n_nodes = 4>
struct TetBatch {
  Real slope[3][3][tet_lanes];  // of corners 1, 2, 3 [1/m]
  Real volume[tet_lanes];       // [m^3]
  std::uint16_t corner[tet_lanes]
                      [n_nodes];  // where in vectors of the block's nodes, four numbers each [8 bytes]
};

struct TetBlock {
  std::size_t first_batch = 0, n_batches = 0;
  std::size_t first_part = 0, n_parts = 0;  // one for each of its nodes
  std::size_t material = 0;
};

/// Who sums which parts, each list in the order of the blocks.
struct PartLists {
  std::vector<Index> begin;  // of each, and the end of the last
  std::vector<Index> part;
};

struct TetLayout {
  std::vector<TetBlock> blocks;
  std::vector<Index> tet;             // of each lane of each batch, -1: left over
  std::vector<std::uint16_t> corner;  // of each lane, its four nodes, of second order its ten
  std::size_t n_nodes = 4;            // of a tetrahedron
  std::vector<Index> node;            // of each part
  std::vector<Index> share;           // of each part: the node as this material has it
  PartLists of_node, of_share;
  std::vector<Index> node_of_share;
  std::vector<std::size_t> material_of_share;

  std::size_t n_batches() const noexcept { return tet.size() / tet_lanes; }
};

/// @param model  renumbered, or blocks have many nodes
TetLayout lay_out(const TetModel& model);

}  // namespace palpate::physics
