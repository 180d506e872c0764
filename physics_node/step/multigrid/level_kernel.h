#pragma once
// All that the kernels of a level need, and where it is.

#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/lattice/kernel_choice.h"
#include "physics_node/step/multigrid/cell_batches.h"

namespace palpate::physics {

/// Numbers of a batch: F by row, q~, stiffness, k_i; sixteen of each.
inline constexpr Index tangent_numbers = 12;

/// A vector of each node, by component.
template <class Real>
using NodeVector = std::array<Real*, 3>;

/// Cells give to the corners of their lower plane through `low` and to those of their upper one through `high`, so that layers may be
/// swept in any order. Both are zero between sweeps.
template <class Real>
struct LevelContext {
  const CellBatch* batches;
  const Index* corners;  // of gathered batches
  const CellLayer* layers;
  const GridPlane* planes;
  Index n_layers;              // and planes
  Real* tangent;               // tangent_numbers x 16 of each batch
  const Real* dense;           // 24 x 24 by column, of each dense cell [N/m]
  const Index* dense_corners;  // 8 of each
  const Real* mass;            // over dt^2; 0: held [N/m]                        (n_nodes)
  const Real* free;            // 1, or 0: held or no node                        (n_nodes)
  NodeVector<Real> u;          // where the tangent is taken [m]
  NodeVector<Real> low, high;
  std::array<Real*, 6> inverse;  // D^-1: xx yy zz yz xz xy
  std::array<Real*, 6> block_high;
  NodeVector<Real> x, r, d;  // solution, what is left of the right side, last step of the smoother
  Real scale;                // of the tangent: 1 + beta / dt
  Real lag = 0;              // of the damper: beta / dt
  HexConstants<Real> k;      // of a cell of this level and of the body's own modulus
};

/// Each works on one layer of cells or one plane of nodes.
template <class Real>
struct LevelKernel {
  using Context = LevelContext<Real>;
  /// F, q~ and k_i of all cells at u; their diagonal blocks into `inverse` and `block_high`.
  void (*linearise)(const Context&, Index layer) = nullptr;
  void (*invert_blocks)(const Context&, Index plane) = nullptr;
  /// low, high += K p, of the cells
  void (*product)(const Context&, const NodeVector<Real>& p, Index layer) = nullptr;
  /// x = d = c D^-1 r
  void (*begin)(const Context&, Index plane, Real c) = nullptr;
  /// r -= A d;  d = c1 d + c2 D^-1 r;  x += d, after product() of d
  void (*smooth)(const Context&, Index plane, Real c1, Real c2) = nullptr;
  /// r -= A d, after product() of d
  void (*residual)(const Context&, Index plane) = nullptr;
  /// q = A p, after product() of p. @return p . q
  double (*keep)(const Context&, const NodeVector<Real>& p, const NodeVector<Real>& q, Index plane) = nullptr;
  /// low, high += forces of the cells and their dampers at u + d, from u on [N]. @return their energy [J]
  double (*forces)(const Context&, Index layer) = nullptr;
  /// f = low + high of what is free, and clears them.
  void (*gather)(const Context&, const NodeVector<Real>& f, Index plane) = nullptr;
};

namespace sse2 {
template <class Real>
LevelKernel<Real> level_kernel(bool physical);
}
namespace avx2 {
template <class Real>
LevelKernel<Real> level_kernel(bool physical);
}
namespace avx512 {
template <class Real>
LevelKernel<Real> level_kernel(bool physical);
}

/// Of the widest vectors that this machine has.
template <class Real>
LevelKernel<Real> level_kernel_here(bool physical) {
  return kernel_for(instruction_set(), physical, &sse2::level_kernel<Real>, &avx2::level_kernel<Real>,
                    &avx512::level_kernel<Real>);
}

}  // namespace palpate::physics
