#pragma once
// What a body's state amounts to: energies, momenta, counts. For reports, not for the step.

#include <algorithm>

#include "physics_node/step/books.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Kinetic (1/2) m v^2, and between velocities m v(-) . v(+) / 2 with the v(+) that the next step of the same dt leads to before
/// anything touches (see element_step.h); elastic f_s^2 / (2 k1) per live element, which is what unloading gives back; gravitational
/// - m g . u. Held masses count for nothing. One pass over masses and elements in double precision.
template <class Real>
Energies measure_energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity);

/// What the next step of the same dt will book that `between` and `elastic` have as done.
template <class Real>
Losses measure_due(const Body& body, const LatticeState<Real>& state);

/// Adds what was seen of a row.
inline void add_watched(const RowLedger& row, Watch& sum) noexcept {
  sum.kinetic += row.kinetic;
  sum.between += row.between;
  sum.elastic += row.elastic;
  sum.fallen += row.fallen;
  sum.fallen_before += row.fallen_before;
  sum.speed = std::max(sum.speed, row.speed2);
}
/// Adds what a row has given away.
inline void add_losses(const RowLedger& row, Losses& sum) noexcept {
  sum += {.viscous = row.viscous,
          .plastic = row.plastic,
          .numerical = row.numerical,
          .broken = row.broken,
          .breaks = row.breaks};
}
/// What elements have given away since the start.
template <class Real>
Losses measure_losses(const LatticeState<Real>& state);

/// Of all masses, held ones too, with velocities v. @return momenta, mass, and what the books of momentum begin with
template <class Real>
MomentumAccount::Start measure_momenta(const Body& body, const Three<Real>& u, const Three<Real>& v) noexcept;
/// The same of a state, with what of a step nodes that are stepped on their own are ahead.
template <class Real>
MomentumAccount::Start measure_momenta(const Body& body, const LatticeState<Real>& state,
                                       const Three<Real>& v) noexcept;

/// All but the shape.
template <class Real>
BodyCounts measure_counts(const Body& body, const LatticeState<Real>& state);
/// BodyCounts::shape_rms [m].
template <class Real>
double measure_shape_rms(const Body& body, const LatticeState<Real>& state);

}  // namespace palpate::physics
