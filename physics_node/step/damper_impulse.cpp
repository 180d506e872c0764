#include "physics_node/step/damper_impulse.h"

#include <bit>

#include "physics_node/body/element_constants.h"

namespace palpate::physics {

template <class Real>
double booked_too_much(const Body& body, const LatticeState<Real>& state, Index cell, const Vec3& dv,
                       double dt, bool verlet) noexcept {
  if (!any_damped(body) || body.law.damper != Damper::axial) return 0;
  const Lattice& lattice = body.lattice;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
  const auto difference = [&](const Three<Real>& of, Index other) {
    return Vec3(vector_of(of, other) - vector_of(of, cell));
  };
  double sum = 0;
  for (Mask mask = state.mask[static_cast<std::size_t>(cell)]; mask != 0; mask &= mask - 1) {
    const auto d = static_cast<std::size_t>(std::countr_zero(mask));
    const Index other = cell + offset[d];
    const Vec3 x = lattice.rest_vector[d] + difference(state.u, other);
    const double l2 = x.squaredNorm();
    if (l2 == 0) continue;
    const double c = element_constants(body, cell, other, d % static_cast<std::size_t>(lattice.n_half)).c;
    const double jump = -dv.dot(x);  // of l l'
    sum += c * dt / l2 * (verlet ? -0.5 * difference(state.v, other).dot(x) * jump : 0.25 * jump * jump);
  }
  return sum;
}

template double booked_too_much(const Body&, const LatticeState<float>&, Index, const Vec3&, double,
                                bool) noexcept;
template double booked_too_much(const Body&, const LatticeState<double>&, Index, const Vec3&, double,
                                bool) noexcept;

}  // namespace palpate::physics
