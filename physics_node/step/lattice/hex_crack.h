#pragma once
// Hexahedra that break together: what a crack takes by its area, it takes once, though cells beside it lose stiffness, too.
//
// Stress at the tip of a crack is highest beside it, and what is opening there is blunt: cells of the layers above and below lose a part
// of their stiffness that they keep, the more layers the finer the cells. They and the one that goes are one crack:
//
//   the open cells that a line of l / 2 along N on either side meets before it comes to one that has not begun, N the direction of the
//   largest stretch at rest of one when it began;
//   l = G_c / (energy of tissue at its limit by volume): the layer whose energy at the limit feeds one crack
//
// Among them the one that lost most leads. What others take is taken off its share, and falls to nobody else:
//
//   left(leader) = G_c A - what it took - what those behind it took
//
// A cell that goes on losing where the crack has passed, pulled by the next to go, has a gap in its line. It then follows
// the one around the gap that lost most.
// Why not shield them instead: a crack that changes from one layer to another leaves cells between its two ends that must
// break, and without end they hold.
// Deviation: the crack band of Bazant & Oh is one layer, whichever it is, and lets those beside it take what they may.

#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

template <class Real>
class CrackShares {
 public:
  /// @param body  outlives this, and its cells break
  explicit CrackShares(const Body& body);

  /// G_c A of a cell that begins. @param normal  N [J]
  double share_of(Index cell, const Vec3& normal) const noexcept;
  /// What is left to a cell that has begun; may be negative [J].
  double left_to(const LatticeState<Real>& state, Index cell) const noexcept;
  /// What a cell took goes on its account, or on that of the one it follows. Call it when all that lose in a step have: who leads does
  /// then not depend on their order.
  void take(LatticeState<Real>& state, Index cell, double taken) const noexcept;

 private:
  /// Visits cells that have begun and are not gone. @return one that is gone and ends the line; -1: none
  template <class Visit>
  Index each_across(const LatticeState<Real>& state, Index cell, const Visit& visit) const noexcept;
  template <class Visit>
  void each_around(const LatticeState<Real>& state, Index cell, const Visit& visit) const noexcept;
  bool is_open(const LatticeState<Real>& state, Index cell) const noexcept;
  Index leader_of(const LatticeState<Real>& state, Index cell) const noexcept;

  const Body& body_;
  std::vector<double> reach_;  // l / 2 of body.solid->failures, of cells of stiffness 1 [m]
};

}  // namespace palpate::physics
