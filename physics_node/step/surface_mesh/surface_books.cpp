// The state of a surface of springs as others push it and save it, and what it has of energy.

#include <algorithm>

#include "common/math/state_hash.h"
#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/surface_mesh/surface_springs.h"

namespace palpate::physics {

template <class Real>
Vec3 SurfaceSprings<Real>::displacement(Index node) const noexcept {
  return vector_at(u_, static_cast<std::size_t>(node));
}

template <class Real>
Vec3 SurfaceSprings<Real>::velocity(Index node) const noexcept {
  return vector_at(v_, static_cast<std::size_t>(node));
}

template <class Real>
void SurfaceSprings<Real>::place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept {
  set_vector(u_, static_cast<std::size_t>(node), displacement);
  set_vector(v_, static_cast<std::size_t>(node), velocity);
  dt_before_ = 0;  // no step came before this state
}

template <class Real>
void SurfaceSprings<Real>::push(Index node, const Vec3& dv, double dt) noexcept {
  const auto n = static_cast<std::size_t>(node);
  set_vector(v_, n, velocity(node) + dv);
  set_vector(u_, n, displacement(node) + dt * dv);
}

template <class Real>
typename SurfaceSprings<Real>::Saved SurfaceSprings<Real>::saved() const {
  return {.u = ZeroedArray<Real>(4 * capacity())};
}

template <class Real>
void SurfaceSprings<Real>::save(Saved& to) const noexcept {
  std::copy_n(u_.data(), 4 * n_nodes(), to.u.data());
  to.viscous = viscous_, to.numerical = numerical_;
  to.watch = watch_;
}

template <class Real>
void SurfaceSprings<Real>::bring_back(const Saved& from) noexcept {
  std::copy_n(from.u.data(), 4 * n_nodes(), u_.data());
  std::fill_n(v_.data(), 4 * n_nodes(), Real(0));
  viscous_ = passed_ = from.viscous, numerical_ = from.numerical;
  watch_ = from.watch;
  watch_.kinetic = watch_.between = watch_.speed = 0;
  stiffening_ = 1;
  dt_before_ = 0;
}

template <class Real>
void SurfaceSprings<Real>::forget() noexcept {
  watch_ = {};
  viscous_ = passed_ = numerical_ = 0;
  stiffening_ = 1;
  dt_before_ = 0;
}

/// Of its springs, and of what resists in it: K (V - V_0)^2 / (2 V_0).
template <class Real>
double SurfaceSprings<Real>::elastic() const noexcept {
  double sum = 0;
  for (const double part : elastic_) sum += part;
  if (!is_filled()) return sum;
  const double more = volume_ - rest_volume_;
  return sum + 0.5 * membrane_.content_modulus * more * more / rest_volume_;
}

/// What p_0 has given. It stays whatever the bag does, as weight does, and is booked as that is: a bag that swells
/// turns it over.
template <class Real>
double SurfaceSprings<Real>::given_by_pressure() const noexcept {
  return is_filled() ? membrane_.pressure * (volume_ - rest_volume_) : 0;
}

template <class Real>
Energies SurfaceSprings<Real>::energies(const Vec3& gravity) noexcept {
  look({});
  Energies e;
  e.elastic = elastic();
  e.gravitational = -given_by_pressure();
  double power = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    if (inverse_mass_[n] == 0) continue;
    const double mass = 1 / inverse_mass_[n];
    const Vec3 v = vector_at(v_, n);
    const Felt felt = this->felt(n);
    e.kinetic += 0.5 * mass * v.squaredNorm();
    e.gravitational -= mass * gravity.dot(vector_at(u_, n));
    power += v.dot(felt.elastic + felt.damping + mass * gravity);
  }
  e.between = e.kinetic + 0.5 * dt_before_ * power;
  return e;
}

template <class Real>
Losses SurfaceSprings<Real>::due() noexcept {
  Losses due{.viscous = passed_ - viscous_};
  look({});
  double of_damper = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n)
    if (inverse_mass_[n] > 0) of_damper -= (felt(n).damping + damping_before_[n]).dot(vector_at(v_, n));
  (of_damper > 0 ? due.viscous : due.numerical) += 0.5 * dt_before_ * of_damper;
  return due;
}

template <class Real>
double SurfaceSprings<Real>::omega2() noexcept {
  look({});
  Fastest sum;
  for (std::size_t n = 0; n < n_nodes(); ++n) sum.add(fastest(n));
  return sum.omega2();
}

template <class Real>
double SurfaceSprings<Real>::gamma() noexcept {
  look_at_springs({});
  double largest = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n)
    largest = std::max(largest, (2 * membrane_.beta * stiffness(n) + drag_[n]) * inverse_mass_[n]);
  return largest;
}

template <class Real>
double SurfaceSprings<Real>::volume() noexcept {
  look_at_volume({});
  return volume_;
}

template <class Real>
double SurfaceSprings<Real>::pressure() noexcept {
  look_at_volume({});
  return leaks_ ? 0 : pressure_;
}

template <class Real>
double SurfaceSprings<Real>::largest_stretch() noexcept {
  look_at_springs({});
  double largest = 1;
  for (std::size_t s = 0; s < joints_.springs.size(); ++s)
    largest = std::max(largest, static_cast<double>(now_[s].length / joints_.springs[s].length));
  return largest;
}

template <class Real>
std::uint64_t SurfaceSprings<Real>::hash(std::uint64_t seed) const noexcept {
  seed = hash_state(u_.data(), 4 * n_nodes() * sizeof(Real), seed);
  return hash_state(v_.data(), 4 * n_nodes() * sizeof(Real), seed);
}

template <class Real>
bool SurfaceSprings<Real>::is_finite() const noexcept {
  for (std::size_t n = 0; n < n_nodes(); ++n)
    if (!vector_at(u_, n).allFinite() || !vector_at(v_, n).allFinite()) return false;
  return true;
}

template class SurfaceSprings<float>;
template class SurfaceSprings<double>;

}  // namespace palpate::physics
