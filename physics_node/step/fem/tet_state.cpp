// The state of a body of tetrahedra as others push it, save it and bring it back.

#include <algorithm>

#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::physics {

template <class Real>
Vec3 Tetrahedra<Real>::displacement(Index node) const noexcept {
  return vector_at(u_, static_cast<std::size_t>(node));
}

template <class Real>
Vec3 Tetrahedra<Real>::velocity(Index node) const noexcept {
  return vector_at(v_, static_cast<std::size_t>(node));
}

template <class Real>
void Tetrahedra<Real>::place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept {
  set_vector(u_, static_cast<std::size_t>(node), displacement);
  set_vector(v_, static_cast<std::size_t>(node), velocity);
  dt_before_ = since_ = 0;  // no step came before this state
}

template <class Real>
void Tetrahedra<Real>::push(Index node, const Vec3& dv, double dt) noexcept {
  const auto n = static_cast<std::size_t>(node);
  set_vector(v_, n, velocity(node) + dv);
  set_vector(u_, n, displacement(node) + dt * dv);
}

template <class Real>
typename Tetrahedra<Real>::Saved Tetrahedra<Real>::saved() const {
  return {.u = Four(u_.size())};
}

template <class Real>
void Tetrahedra<Real>::save(Saved& to) const noexcept {
  std::copy_n(u_.data(), 4 * n_nodes(), to.u.data());
  to.viscous = viscous_, to.numerical = numerical_;
  to.watch = watch_;
}

template <class Real>
void Tetrahedra<Real>::copy_saved(Saved& in, Index node, Index copy) const noexcept {
  std::copy_n(in.u.data() + 4 * static_cast<std::size_t>(node), 4,
              in.u.data() + 4 * static_cast<std::size_t>(copy));
}

template <class Real>
void Tetrahedra<Real>::bring_back(const Saved& from) noexcept {
  std::copy_n(from.u.data(), 4 * n_nodes(), u_.data());
  std::fill_n(v_.data(), 4 * n_nodes(), Real(0));
  viscous_ = passed_ = from.viscous, numerical_ = from.numerical;
  watch_ = from.watch;
  watch_.kinetic = watch_.between = watch_.speed = 0;
  stiffening_ = 1;
  dt_before_ = since_ = 0;
}

template <class Real>
void Tetrahedra<Real>::forget() noexcept {
  watch_ = {};
  viscous_ = passed_ = numerical_ = 0;
  stiffening_ = least_of_all_J_ = 1;
  dt_before_ = since_ = 0;
}

#define PALPATE_STATE_OF(Real)                                                     \
  template Vec3 Tetrahedra<Real>::displacement(Index) const noexcept;              \
  template Vec3 Tetrahedra<Real>::velocity(Index) const noexcept;                  \
  template void Tetrahedra<Real>::place(Index, const Vec3&, const Vec3&) noexcept; \
  template void Tetrahedra<Real>::push(Index, const Vec3&, double) noexcept;       \
  template Tetrahedra<Real>::Saved Tetrahedra<Real>::saved() const;                \
  template void Tetrahedra<Real>::save(Saved&) const noexcept;                     \
  template void Tetrahedra<Real>::copy_saved(Saved&, Index, Index) const noexcept; \
  template void Tetrahedra<Real>::bring_back(const Saved&) noexcept;               \
  template void Tetrahedra<Real>::forget() noexcept;

PALPATE_STATE_OF(float)
PALPATE_STATE_OF(double)
#undef PALPATE_STATE_OF

}  // namespace palpate::physics
