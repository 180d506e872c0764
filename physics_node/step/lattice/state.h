#pragma once
// What changes of a lattice body: structure of arrays over storage cells, in the precision of the scene.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/fast_nodes.h"
#include "physics_node/step/lattice/fresh_breaks.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

template <class Real>
using Three = std::array<ZeroedArray<Real>, 3>;  // x, y, z
template <class Real>
Vec3 vector_of(const Three<Real>& three, Index cell) noexcept {
  const auto c = static_cast<std::size_t>(cell);
  return {static_cast<double>(three[0][c]), static_cast<double>(three[1][c]),
          static_cast<double>(three[2][c])};
}
template <class Real>
using ByHalf = std::array<ZeroedArray<Real>, max_half>;  // by half direction

/// Constants of each element, at the end from which its direction is of the first half; only where materials meet.
template <class Real>
struct VariedConstants {
  ByHalf<Real> k1, k2, c, yield, snap;  // as in ElementSlot  (n_cells)
  ZeroedArray<Real> drag;               // of each mass, where it differs [N s/m]  (n_cells)
};

/// What cells have lost, by their lowest corner: see hex_failure.h.
template <class Real>
struct FailedCells {
  ZeroedArray<Real> damage;  // share of its stiffness that is gone; 1: broken                      (n_cells)
  ZeroedArray<Real>
      reached;              // most energy of the whole cell in tension; 0: it has not begun [J]     (n_cells)
  ZeroedArray<Real> left;   // that the crack may take of it yet; 0: no more than it holds [J]      (n_cells)
  ZeroedArray<Real> taken;  // of what it took, what is on no other cell's account [J]              (n_cells)
  Three<Real> normal;       // N of hex_crack.h, when it began                                      (n_cells)
  std::uint64_t changes = 0;  // how often any of them was another one

  auto arrays() noexcept { return arrays_of(*this); }
  auto arrays() const noexcept { return arrays_of(*this); }

 private:
  static auto arrays_of(auto& of) noexcept {
    return std::array{&of.damage,    &of.reached,   &of.left,     &of.taken,
                      &of.normal[0], &of.normal[1], &of.normal[2]};
  }
};

/// What cells have yielded, by their lowest corner: see step/fem/hex_plastic.h.
template <class Real>
struct YieldedCells {
  std::vector<ZeroedArray<Real>> memory;  // by entry of Plastic; EMPTY: nothing yields     (n_cells)
  std::uint64_t changes = 0;              // how often any of them was another one
};

template <class Real>
struct LatticeState {
  Three<Real> u, v;           // displacement from rest [m], velocity [m/s]               (n_cells)
  Three<Real> f;              // force gathered so far; zero between steps [N]            (n_cells)
  Three<Real> v_half;         // velocity half a step ago; only for velocity_verlet       (n_cells)
  bool v_half_known = false;  // false: the next step of velocity_verlet is the first
  Three<Real> v_seen;  // that dampers saw in the last step; only where something may touch or press (n_cells)
  bool v_seen_known = false;
  double dt_before = 0;            // of the last explicit step; 0: there was none [s]
  ZeroedArray<Mask> mask;          // live elements                                            (n_cells)
  ByHalf<Real> l_c;                // plastic stretch [m]; only where a material yields        (n_cells)
  ByHalf<Real> hardening;          // l - L at yield, less that at first yield [m]; only there (n_cells)
  ZeroedArray<Real> inverse_mass;  // constant, in this precision                       (n_cells)
  VariedConstants<Real> varied;
  std::vector<ZeroedArray<Real>>
      remembered;            // of each cell, by term and entry of Remembered; only where it relaxes (n_cells)
  FailedCells<Real> failed;  // only where cells break
  YieldedCells<Real> plastic;      // only where cells yield
  FastNodes<Real> fast;            // only where cells are stepped on their own
  std::uint64_t replacements = 0;  // how often the state was set from outside

  std::array<SlotList<Real>, max_row_kinds> all, level, up;  // constant: see ElementContext
  std::vector<RowState> row_state;                           // by row
  std::uint64_t row_changes = 0;                             // how often row_state was another one
  std::vector<std::uint8_t>
      acts;  // of each run, 1: acts; only of a body that is awake in parts, else rows decide
  std::vector<RowLedger> ledger;  // by row; of cells that may be cut one more, of what was parted
  std::vector<Index> woken;       // rows whose ledger began anew since the last step; only beside `acts`
  std::int64_t breaks = 0;        // of all rows, when the masks were last mirrored
  FreshBreaks fresh;              // of the last step; only where elements may go

  explicit LatticeState(const Body& body);
  void reset(const Body& body);
  /// After a reset. @param start  displacements, of the nodes in their order; EMPTY: none [m]
  void start_from(const Body& body, std::span<const Vec3> start);
  /// No step came before this state: what the next one begins with is what there is.
  void forget_last_step() noexcept { v_half_known = v_seen_known = false, dt_before = 0; }
};

/// Of displacement, velocity, live elements and plastic state of all masses, continued from `seed`.
template <class Real>
std::uint64_t hash_of(const Body& body, const LatticeState<Real>& state, std::uint64_t seed) noexcept;

/// The velocity that moved the masses in the last step, whose momentum forces change and nothing else.
template <class Real>
const Three<Real>& moving_velocity(const LatticeState<Real>& state) noexcept {
  return state.v_half[0].size() > 0 ? state.v_half : state.v;
}

/// What a mass has been through.
template <class Real>
bool has_yielded(const Body& body, const LatticeState<Real>& state, Index cell) noexcept;

/// How many of a mass's live elements have yielded, [0, 1]; of a mass without any, whether one had before it broke.
template <class Real>
double yielded_share(const Body& body, const LatticeState<Real>& state, Index cell) noexcept;

}  // namespace palpate::physics
