#pragma once
// All elements of a body at a trial state: their forces, and how these change. For backward_euler.

#include <array>
#include <span>

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// A vector per storage cell: component a of cell i at [a][i].
using Field = std::array<ZeroedArray<double>, 3>;
inline Vec3 vector_at(const Field& field, Index cell) noexcept {
  const auto c = static_cast<std::size_t>(cell);
  return {field[0][c], field[1][c], field[2][c]};
}

/// What one implicit step does to the energy, beyond what the forces at its end say.
struct StepLosses {
  double viscous = 0;  // [J]
  double numerical =
      0;  // of the elements: force at the end times motion, less what is stored and what yield and break took [J]
};

/// At displacements u_n + D and velocities D / dt, by element, with n its direction and r the velocity of its far end:
///   force           (f_s(l) + c l') n              other dampers of the papers: f_s n + c r; drag is not here but at the masses
///   minus its rate  a n n^T + b (I - n n^T),  a = df_s/dl + c / dt,  b = f / l: negative where an element is compressed
/// Everything is in double precision, whatever the state is in.
template <class Real>
class LinearisedElements {
 public:
  explicit LinearisedElements(const Body& body);

  /// Adds to every mass what its live elements drag at it (the damper - c v of the papers) [N s/m].
  void add_drag(const Body& body, const LatticeState<Real>& state, ZeroedArray<double>& drag) const;
  /// Evaluates all live elements and adds their forces to `force`.
  void evaluate(const Body& body, const LatticeState<Real>& state, const Field& D, double dt, Field& force);
  /// out := out + A y
  void add_product(const Body& body, const Field& y, Field& out) const;
  /// Adds the 3 x 3 blocks of A on the diagonal: xx yy zz yz xz xy of each cell; b as if it were never negative (Choi &
  /// Ko 2002), so that they can precondition.
  void add_blocks(const Body& body, std::array<ZeroedArray<double>, 6>& blocks) const;
  /// Of the state evaluated last, reached from the state by D.
  StepLosses losses(const Body& body, const LatticeState<Real>& state, const Field& D, double dt) const;

 private:
  struct Slot {
    ZeroedArray<double> n[3], a, b;  // by the cell of the first end
  };
  std::array<Slot, max_slots> slots_;
};

}  // namespace palpate::physics
