#pragma once
// All that the element kernel needs for one step, in the precision of the state.

#include <cstdint>

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

inline constexpr int max_slots = 10;

/// One of the elements that every mass of a row may have, seen from the end that comes first in storage.
template <class Real>
struct ElementSlot {
  Index offset = 0;       // to the other end
  Index memory = 0;       // to the end that holds the element's constants and memory: 0 or offset
  std::uint32_t bit = 0;  // of the element in the mask of the first end
  int half = 0;           // half direction, which picks the arrays below
  Real D[3] = {};         // rest vector to the other end [m]
  Real L = 0, L2 = 0;     // its length, and that squared [m, m^2]
  Real least_q = 0;       // of l^2 - L^2 [m^2]
  Real k1 = 0, k2 = 0, c = 0;
  Real half_over_k1 = 0;  // 1 / (2 k1)
  Real yield = 0;         // l - L at first yield [m]
  Real snap = 0;          // l - L at break [m]
};

template <class Real>
struct SlotList {
  int n = 0;
  ElementSlot<Real> slot[max_slots];
};

/// What the elements and masses of a row have given away, and what they did last. Kept by row so that no two threads
/// share one.
struct RowLedger {
  double viscous = 0;    // [J] lost in dampers, in all
  double plastic = 0;    // [J] lost in yielding, in all
  double numerical = 0;  // [J] lost to the way time is stepped, in all; either sign
  double broken = 0;     // [J] elastic energy of elements when they broke, in all
  std::int64_t breaks = 0;
  std::int64_t mirrored = 0;  // breaks that both ends of their elements know of
  std::int64_t yields = 0;    // times that an element yielded
  // when last watched:
  double speed2 = 0;         // largest of the row [m^2/s^2]
  double acceleration2 = 0;  // largest of the row [m^2/s^4]
  double kinetic = 0;        // with the velocities after the step [J]
  double between = 0;        // kinetic, with those before and after the step: sum of m v(-) . v(+) / 2 [J]
  double fallen = 0;         // energy that gravity has given, sum of m g . u [J]
  double fallen_before = 0;  // the same before the step [J]
  double elastic = 0;        // of its elements, before the step [J]
  double elastic_up =
      0;  // part of it in elements to the next plane, where these are a sweep of their own [J]
};

enum class RowState : std::uint8_t {
  awake,
  rim,  // sleeps beside an awake row: its masses stand, its elements act, and it watches for a reason to wake
  far_rim,  // sleeps beside a rim row, whose watch needs its elements
  asleep,   // sleeps among sleeping rows: nothing is computed
};

template <class Real>
struct ElementContext {
  const RowSegment* rows;
  const RowState* row_state;    // by row
  RowLedger* ledger;            // by row
  const SlotList<Real>* all;    // by row kind: all elements of a mass that it is the first end of
  const SlotList<Real>* level;  //   those within its plane of z
  const SlotList<Real>* up;     //   those to the next plane
  Real* u[3];                   // displacement [m]                  (n_cells)
  Real* v[3];                   // velocity [m/s]                    (n_cells)
  Real* f[3];                   // force so far; zero between steps  (n_cells)
  Real* v_half[3];              // velocity half a step ago; only velocity_verlet (n_cells)
  const Real* kicked[3];        // the velocity that the kick adds to; only velocity_verlet (n_cells)
  const Real* moved[3];         // the velocity that moved the masses to where they are     (n_cells)
  Real* v_seen[3];            // the velocity that dampers saw one step ago; only KernelKind::exact (n_cells)
  const Real* inverse_mass;   // 0: held or empty [1/kg]           (n_cells)
  Mask* mask;                 // live elements                     (n_cells)
  Real* l_c[max_half];        // plastic stretch [m]; only with yield             (n_cells)
  Real* hardening[max_half];  // how far the yield stretch has moved [m]; only with yield (n_cells)
  const Real* k1[max_half];   // of each element; only where several materials meet (n_cells)
  const Real* k2[max_half];
  const Real* c[max_half];
  const Real* yield[max_half];
  const Real* snap[max_half];
  Real dt, g[3];
  Real dt_before;       // of the step before; 0: there was none
  Real kick;            // dt, or dt / 2 in the first step of velocity_verlet
  Real drag;            // of every mass [N s/m]
  const Real* drag_of;  // of each mass, where they differ; else null [N s/m]  (n_cells)
  bool relative;        // which of the papers' other dampers: c (v_j - v_i), or c v_i
  bool watch;           // note speeds, accelerations and energies in the ledger
  bool exact;           // something may be struck: books what is small elsewhere
  bool exact_axial;     // dampers along elements, and KernelKind::exact
  bool begins;          // the step before was of another dt, or there was none: books what that changes
};

/// axial: c l' u; other: c (v_j - v_i) or c v_i, as printed in the papers.
enum class DamperKind : std::uint8_t { none, axial, other };

/// What a body's material has: what it lacks is not in the loop.
struct KernelKind {
  DamperKind damper = DamperKind::none;
  bool yields = false;
  bool varied = false;  // several materials: constants by element
  bool verlet = false;
  bool exact = false;  // books the work of dampers as the integrator does it: see element_step.h
};

/// Which elements of the rows to compute.
enum class Sweep : std::uint8_t {
  up,     // those into the next plane only; no mass moves
  level,  // those within the plane; then the masses of the row move
  all,    // all; then the masses of the row move
};

/// Steps some rows in place. See element_step.h for what it computes and in which order rows must come.
template <class Real>
using ElementKernel = void (*)(const ElementContext<Real>&, Index first_row, Index last_row, Sweep sweep);

/// The kernel of an instruction set; sse2 is every x86-64 machine's. avx2 and avx512 give the same bits; sse2, which
/// cannot fuse a multiplication with an addition, gives others.
namespace sse2 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}
namespace avx2 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}
namespace avx512 {
template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind);
}

enum class InstructionSet { sse2, avx2, avx512 };
/// The widest that this machine runs, or the narrower one that PALPATE_ISA names (sse2, avx2).
InstructionSet instruction_set() noexcept;
const char* name_of(InstructionSet set) noexcept;

}  // namespace palpate::physics
