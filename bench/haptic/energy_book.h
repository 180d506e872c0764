#pragma once
// The energy balance of a haptic renderer, seen from outside: true positions, forces really applied.
//
//   E_port[n]  = sum F_k . (x_{k+1} - x_k)       given to the hand
//   E_plane[n]                                   work that moving planes put in
//   S[n]       = K d^2 / 2                       stored in the springs now
//   G[n]       = E_port + S - E_plane            generated: passive while at most G_allowed
//   E_plane[n] - min E_plane[m <= n] <= cap + allowance (t_n - t_m), and one cap more for each contact after a rest

#include <algorithm>

#include "common/math/vec3.h"

namespace palpate::bench {

class EnergyBook {
 public:
  static constexpr double G_allowed = 0.1e-3;  // [J]
  static constexpr double cap = 0.2e-3;        // [J]
  static constexpr double allowance = 5e-3;    // [W]
  static constexpr double rest = 0.05;         // without contact, after which a contact counts as new [s]

  void moved(const Vec3& force, const Vec3& by) noexcept { given(force.dot(by)); }
  void given(double work) noexcept { port_ += work; }

  /// Once a tick, after the renderer has answered.
  void tick(double dt, double stored, double plane_work, bool touching) noexcept {
    surplus_ = std::max(surplus_, port_ + stored - plane_work);
    port_most_ = std::max(port_most_, port_);
    if (touching) {
      if (free_for_ >= rest) paid_ += cap;
      free_for_ = 0;
    } else {
      free_for_ += dt;
    }
    paid_ += allowance * dt;
    const double net = plane_work - paid_;
    least_ = std::min(least_, net);
    excess_ = std::max(excess_, net - least_ - cap);
  }

  double port() const noexcept { return port_; }            // now [J]
  double port_most() const noexcept { return port_most_; }  // largest so far [J]
  double surplus() const noexcept { return surplus_; }      // largest G so far [J]
  /// Largest breach of the bound on the work of planes so far [J]; not above 0: kept.
  double plane_excess() const noexcept { return excess_; }

 private:
  double port_ = 0, port_most_ = 0, surplus_ = 0;
  double paid_ = 0, least_ = 0, excess_ = -cap;
  double free_for_ = 0;
};

}  // namespace palpate::bench
