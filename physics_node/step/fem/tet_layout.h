#pragma once
// Tetrahedra in the order in which a step meets them: blocks of some hundred that one thread takes at a time.
//
// A block copies its nodes, computes its tetrahedra sixteen at a time, and sums what they do to its nodes in a part of its own. Then
// each node sums its parts. Both orders depend on the mesh alone, so that every sum is the same on any number of threads and by
// vectors of any width, and what a tetrahedron does to its corners never leaves the first-level cache.

#include <cstdint>

#include "physics_node/body/tet_model.h"
#include "physics_node/mesh/simplex_net.h"

namespace palpate::physics {

inline constexpr std::size_t tet_lanes = 16;
inline constexpr std::size_t most_block_tets = 1024;
/// Why: with its copy and its part, 24 KiB in single precision. A good order needs 300.
inline constexpr std::size_t most_block_nodes = 768;
/// Of a body that may be cut. Why: so many have room in a block even if no two share a node any more.
inline constexpr std::size_t most_cut_block_tets = most_block_nodes / 4;

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
  std::size_t most_shares = 0;  // there will ever be

  std::size_t n_batches() const noexcept { return tet.size() / tet_lanes; }
};

/// @param model  renumbered, or blocks have many nodes
/// @param most_copies  of nodes that cuts may make, for which there is room then; of first order
TetLayout lay_out(const TetModel& model, std::size_t most_copies = 0);

/// Where the lanes of tetrahedra are in a layout that changes.
class TetLanes {
 public:
  explicit TetLanes(const TetLayout& layout);
  std::size_t lane(Index tet) const noexcept { return lane_[static_cast<std::size_t>(tet)]; }
  std::size_t block(std::size_t lane) const noexcept { return block_[lane / tet_lanes]; }

 private:
  std::vector<std::size_t> lane_;   // by tetrahedron
  std::vector<std::size_t> block_;  // by batch
};

/// The tetrahedra that have this copy in the net have it from now on; every copy once. Lists are of no use until
/// list_anew(). Allocates nothing.
void give_copy(TetLayout& layout, const TetLanes& lanes, const TetNet& net, Index copy) noexcept;
/// Lists of the parts as they are now. Allocates nothing. @param n_nodes  now
void list_anew(TetLayout& layout, std::size_t n_nodes) noexcept;

}  // namespace palpate::physics
