#pragma once
// Coulomb friction of a point on planes: the proxy sticks to the surface until the force leaves the friction cone, then
// it is dragged along on the cone's edge.
//
//   d = (1 - n n^T) (s - x),    F_t = k d,    |F_t| <= mu |F_n|        s where the proxy sticks, n = F_n / |F_n|
//   sticks: s stays.   slips: d := d mu |F_n| / (k |d|), s := x + d
//
// Nothing ever lengthens d but the hand, so what the spring k |d|^2 / 2 gives back was put in by the hand. A plane that
// turns, or a spring that stiffens, shortens d.
// Source: Harwin & Melder 2002 (friction cone); Zilles & Salisbury 1995. Deviation: one coefficient, for sticking and
// sliding; k is the hand's spring in series with the tissue's, as for the normal force, so that tissue under a stuck
// proxy gives way along the surface as it does across it.

#include <Eigen/Core>

#include "common/math/vec3.h"

namespace palpate::haptic {

class Friction {
 public:
  /// @param coefficient  mu >= 0; 0: none
  explicit Friction(double coefficient) noexcept : coefficient_(coefficient) {}

  bool applies() const noexcept { return coefficient_ > 0; }

  /// Contract: real time; once a tick.
  /// @param x       hand [m]
  /// @param normal  force of the planes on the hand, F_n [N]; zero: nothing is touched, and nothing sticks any more
  /// @param k       stiffness along the surface [N/m], > 0 in contact
  /// @return F_t on the hand [N]
  Vec3 tick(const Vec3& x, const Vec3& normal, double k) noexcept {
    const double pressing = normal.norm();
    if (!(pressing > 0) || !(k > 0)) {
      release();
      return Vec3::Zero();
    }
    if (!sticks_) at_ = x;
    const Vec3 n = normal / pressing;
    Vec3 d = at_ - x;
    d -= n.dot(d) * n;
    if (sticks_ && k > k_) d *= k_ / k;  // the same force, less energy
    const double most = coefficient_ * pressing / k;
    slips_ = d.norm() > most;
    if (slips_) d *= most / d.norm();
    sticks_ = true;
    k_ = k;
    at_ = x + d;
    stored_ = 0.5 * k * d.squaredNorm();
    return k * d;
  }

  void release() noexcept {
    sticks_ = slips_ = false;
    stored_ = 0;
  }

  bool slips() const noexcept { return slips_; }
  double stored() const noexcept { return stored_; }  // [J]

 private:
  double coefficient_;
  bool sticks_ = false, slips_ = false;
  Vec3 at_ = Vec3::Zero();  // s [m]
  double k_ = 0;            // of the last tick [N/m]
  double stored_ = 0;
};

}  // namespace palpate::haptic
