#pragma once
// Regions at rest cost nothing: rows of masses that sleep, and what wakes them.

#include <cstdint>
#include <vector>

#include "physics_node/step/awake_parts.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Rows fall asleep after they were slow and balanced for a while: every mass below 0.05 mm/s and 0.02 m/s^2 for 0.2 s.
/// A sleeping row stands still. Where it borders on awake rows its elements go on acting on them, and it is woken, with
/// the rows beside it, when the forces on one of its masses are out of balance by 0.08 m/s^2; so the error of a mass in a
/// mode of f hertz stays below 0.08 / (2 pi f)^2 metres, 20 um at 10 Hz. Whoever pushes a row wakes it.
/// Only bodies that something holds sleep: a free one must keep its momentum. What relaxes does not, nor what takes more than half a
/// second (viscosity over modulus) to come to its place: they creep slower than any threshold. A body that is awake in parts (awake_region.h) has rows of its own kind.
class Sleep {
 public:
  explicit Sleep(const Body& body);

  /// One look at what the last watched step saw of each row.
  /// @param seconds  since the last look in which rows may fall asleep; 0: none does in this
  template <class Real>
  void look(const Body& body, LatticeState<Real>& state, double seconds) noexcept;

  /// Wakes the row of a cell, if it sleeps, and those beside it.
  template <class Real>
  void wake_cell(const Body& body, LatticeState<Real>& state, Index cell) noexcept;
  template <class Real>
  void wake_all(const Body& body, LatticeState<Real>& state) noexcept;

  bool any_asleep() const { return sleeping_masses_ > 0; }
  Index sleeping_masses() const { return sleeping_masses_; }

 private:
  template <class Real>
  void disturb(LatticeState<Real>& state, std::size_t row) noexcept;
  template <class Real>
  void wake_row(const Body& body, LatticeState<Real>& state, Index row) noexcept;
  /// Tells rims from sleepers after rows have changed.
  template <class Real>
  void classify(const Body& body, LatticeState<Real>& state) noexcept;

  bool may_sleep_;
  std::vector<Index> beside_, beside_begin_;  // rows whose masses share elements with a row's
  std::vector<float> quiet_s_;                // by row: for how long
  std::vector<Index> masses_of_;              // by row; its cells count gaps too
  std::vector<RowState> before_;              // by row, scratch
  Index sleeping_masses_ = 0;
};

/// Does a node stand, its row asleep or on the rim of what is awake, or beyond the parts that are?
/// @param parts  null: the body is not awake in parts
template <class Real>
bool is_asleep(const Body& body, const LatticeState<Real>& state, const AwakeParts* parts,
               Index node) noexcept {
  if (parts != nullptr) return parts->rests(node);
  return state.row_state[static_cast<std::size_t>(body.lattice.row_of(body.origin(node)))] != RowState::awake;
}

}  // namespace palpate::physics
