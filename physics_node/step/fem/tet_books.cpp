// What a body of tetrahedra has of energy and momentum.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/math/state_hash.h"
#include "physics_node/mesh/mesh_parts.h"
#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::physics {

template <class Real>
Energies Tetrahedra<Real>::energies(const Vec3& gravity) {
  Energies e;
  elements(context(), {}, sweep(), sweep().watched_forces);
  e.elastic = elastic();
  double power = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    if (inverse_mass_[n] == 0) continue;
    const double mass = 1 / static_cast<double>(inverse_mass_[n]);
    const Vec3 v = vector_at(v_, n);
    e.kinetic += 0.5 * mass * v.squaredNorm();
    e.gravitational -= mass * gravity.dot(vector_at(u_, n));
    power += mass * v.dot(gravity);
    for (Index p = layout_.of_node.begin[n]; p < layout_.of_node.begin[n + 1]; ++p)
      power += v.dot(
          vector_at(force_, static_cast<std::size_t>(layout_.of_node.part[static_cast<std::size_t>(p)])));
  }
  e.between = e.kinetic + 0.5 * dt_before_ * power;
  return e;
}

template <class Real>
Losses Tetrahedra<Real>::losses() const noexcept {
  return {.viscous = viscous_, .numerical = numerical_};
}

template <class Real>
Losses Tetrahedra<Real>::due() {
  if (model_.beta == 0 || dt_before_ == 0) return {};
  Losses due{.viscous = passed_ - viscous_};
  if (!rate_known_) {
    elements(context(), {}, sweep(), sweep().energies);
    due.viscous += lost_by_power();
    return due;
  }
  elements(context(), {}, sweep(), sweep().apart);
  double of_damper = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    Vec3 force = vector_at(seen_rate_, n);
    for (Index p = layout_.of_node.begin[n]; p < layout_.of_node.begin[n + 1]; ++p)
      force +=
          vector_at(rate_force_, static_cast<std::size_t>(layout_.of_node.part[static_cast<std::size_t>(p)]));
    of_damper -= force.dot(vector_at(v_, n));
  }
  (of_damper > 0 ? due.viscous : due.numerical) += 0.5 * dt_before_ * of_damper;
  return due;
}

template <class Real>
double Tetrahedra<Real>::damper_power() {
  if (power_.empty()) return 0;
  elements(context(), {}, sweep(), sweep().energies);
  return std::accumulate(power_.begin(), power_.end(), 0.0);
}

template <class Real>
double Tetrahedra<Real>::largest_stretch() const {
  double largest2 = 1;
  for (const auto& corners : filled_tets(model_.mesh)) {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
    const auto slopes = slopes_of(model_.mesh, corners);
    for (std::size_t k = 0; k < 3; ++k)
      gradient += (displacement(corners[k + 1]) - displacement(corners[0])) * slopes[k].transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squared(gradient.transpose() * gradient,
                                                                 Eigen::EigenvaluesOnly);
    largest2 = std::max(largest2, squared.eigenvalues()[2]);
  }
  return std::sqrt(largest2);
}

template <class Real>
Watch Tetrahedra<Real>::watch() const noexcept {
  return watch_;
}

template <class Real>
Momenta Tetrahedra<Real>::momenta() const noexcept {
  Momenta sum;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    if (inverse_mass_[n] == 0) continue;
    const Vec3 p = vector_at(v_, n) / static_cast<double>(inverse_mass_[n]);
    sum.linear += p;
    sum.angular += (model_.mesh.nodes[n] + vector_at(u_, n)).cross(p);
  }
  return sum;
}

template <class Real>
std::uint64_t Tetrahedra<Real>::hash(std::uint64_t seed) const noexcept {
  seed = hash_state(u_.data(), 4 * n_nodes() * sizeof(Real), seed);
  return hash_state(v_.data(), 4 * n_nodes() * sizeof(Real), seed);
}

template <class Real>
bool Tetrahedra<Real>::is_finite() const noexcept {
  for (std::size_t n = 0; n < n_nodes(); ++n)
    if (!vector_at(u_, n).allFinite() || !vector_at(v_, n).allFinite()) return false;
  return true;
}

template Energies Tetrahedra<float>::energies(const Vec3&);
template Losses Tetrahedra<float>::losses() const noexcept;
template Losses Tetrahedra<float>::due();
template double Tetrahedra<float>::damper_power();
template double Tetrahedra<float>::largest_stretch() const;
template Watch Tetrahedra<float>::watch() const noexcept;
template Momenta Tetrahedra<float>::momenta() const noexcept;
template std::uint64_t Tetrahedra<float>::hash(std::uint64_t) const noexcept;
template bool Tetrahedra<float>::is_finite() const noexcept;
template Energies Tetrahedra<double>::energies(const Vec3&);
template Losses Tetrahedra<double>::losses() const noexcept;
template Losses Tetrahedra<double>::due();
template double Tetrahedra<double>::damper_power();
template double Tetrahedra<double>::largest_stretch() const;
template Watch Tetrahedra<double>::watch() const noexcept;
template Momenta Tetrahedra<double>::momenta() const noexcept;
template std::uint64_t Tetrahedra<double>::hash(std::uint64_t) const noexcept;
template bool Tetrahedra<double>::is_finite() const noexcept;

}  // namespace palpate::physics
