#pragma once
// All that the kernel of tetrahedra needs for one step, and where it is.

#include "physics_node/step/fem/tet10_element.h"
#include "physics_node/step/fem/tet_element.h"
#include "physics_node/step/fem/tet_layout.h"
#include "physics_node/step/lattice/kernel_choice.h"

namespace palpate::physics {

/// What a chunk of nodes did in a step; kept by chunk so that no two threads share one.
struct TetNodeLedger {
  double of_damper = 0;  // - (f + f_before) . v of the damper's forces; only where they are known [W]
  double numerical = 0;  // what another dt than before takes; only where it is another [J]
  // when watched:
  double speed2 = 0;         // largest [m^2/s^2]
  double kinetic = 0;        // with the velocities after the step [J]
  double between = 0;        // sum of m v(-) . v(+) / 2, see lattice/element_step.h [J]
  double fallen = 0;         // sum of m g . u [J]
  double fallen_before = 0;  // the same before the step [J]
};

/// Vectors of nodes and of parts have four entries, x, y, z and one more, so that one is loaded at once.
template <class Real>
struct TetContext {
  const TetBatch<Real>* batches;
  const TetBatch<Real, 10>* batches10;  // in their place, of second order
  const TetBlock* blocks;
  const TetConstants<Real>* constants;  // of each material
  const Index* node;                    // of each part
  const Index* share;
  const Index* node_begin;  // lists of parts
  const Index* node_part;
  const Index* share_begin;
  const Index* share_part;
  const Real* share_volume;         // 1 / V_n [1/m^3]                              (shares)
  const double* share_energy;       // lambda V_n / 2 [J]                           (shares)
  const double* stiffness_at_rest;  // of each material: bound of the tangent of its stress [Pa]
  Real* u;                          // displacement [m]                             (4 nodes)
  Real* v;                          // velocity [m/s]                               (4 nodes)
  Real* seen_rate;                  // forces of the damper one step ago; only apart [N] (4 nodes)
  const Real* inverse_mass;         // 0: held [1/kg]                               (nodes)
  Real* force;                      // of each part [N]                             (4 parts)
  Real* rate_force;                 // of the damper alone; only apart [N]          (4 parts)
  /// Of each part, sum of V_t / 4 (J_t - 1), damped one after the other with that of V_t / 4 J_t'; only with nodal pressure [m^3, m^3/s]
  Real* swelling;                // (parts, or twice)
  Real* mean;                    // j_n; only with nodal pressure                (shares)
  Real* mean_rate;               // j_n'; only damped, too [1/s]                 (shares)
  const Real* mean_rate_before;  // one step ago
  double* power;  // that the damper takes from each batch, without that of shares; only damped [W]
  const double* power_before;  // one step ago
  double* power_of_shares;     // of each chunk of shares, when damped [W]
  double* lost;            // by dt, in each block since the step before, see damper_loss(); only damped [W]
  double* lost_of_shares;  // and in each chunk of shares [W]
  double* elastic;         // of each block, when asked for [J]
  double*
      stiffest;  // of each block: the same of its stiffest tetrahedron as it is, over that at rest; when asked for
  double* least_J;            // of each block, when asked for
  double* elastic_of_shares;  // of each chunk of shares, when asked for [J]
  TetNodeLedger* ledger;      // of each chunk of nodes
  Real dt, kick, g[3];        // for which nodes move; for which forces act
  Real dt_before;             // for which they acted last; 0: they have not
  Real beta;                  // of the damper [s]
  double z;                   // beta / 2 times the fastest frequency at rest
  bool watch;
  bool begins;  // that was of another length, or they have not
};

enum class TetKind { plain, nodal, second_order };

/// Nodes and shares that are done at a time.
inline constexpr Index tet_chunk = 1024;

/// What computes the elements.
template <class Real>
struct TetSweep {
  using OfBlock = void (*)(const TetContext<Real>&, std::size_t block);
  using OfChunk = void (*)(const TetContext<Real>&, std::size_t chunk, Index end);
  OfBlock swell = nullptr;           // only with nodal pressure: volumes of all tetrahedra to the parts
  OfChunk average = nullptr;         // only with nodal pressure: parts to shares
  OfBlock forces = nullptr;          // of all tetrahedra to the parts
  OfBlock watched_forces = nullptr;  // and energy, stiffness, least J
  OfBlock energies = nullptr;        // the same without forces
  OfBlock apart = nullptr;           // watched, and the damper's forces by themselves, too; only damped
};

template <class Real>
struct TetKernel {
  TetSweep<Real> elastic, damped;
  typename TetSweep<Real>::OfChunk move = nullptr;        // parts to nodes, which move
  typename TetSweep<Real>::OfChunk move_apart = nullptr;  // and books what the damper's forces do
};

namespace sse2 {
template <class Real>
TetKernel<Real> tet_kernel(TetKind kind);
}
namespace avx2 {
template <class Real>
TetKernel<Real> tet_kernel(TetKind kind);
}
namespace avx512 {
template <class Real>
TetKernel<Real> tet_kernel(TetKind kind);
}

/// @param set  that this machine runs
template <class Real>
TetKernel<Real> tet_kernel_of(InstructionSet set, TetKind kind) {
  return kernel_for(set, kind, &sse2::tet_kernel<Real>, &avx2::tet_kernel<Real>, &avx512::tet_kernel<Real>);
}

}  // namespace palpate::physics
