#include "haptic_node/tissue/friction_contact.h"

#include <algorithm>

namespace palpate::haptic {

FrictionContact solve_contact(const Mat3& C, const Vec3& e, const Vec3& n, double friction) noexcept {
  return solve_contact(C, C.inverse(), e, n, friction);
}

FrictionContact solve_contact(const Mat3& C, const Mat3& inverse, const Vec3& e, const Vec3& n,
                              double friction) noexcept {
  FrictionContact contact;
  const double p = -n.dot(e);
  if (!(p > 0)) {
    contact.gap = e + p * n;
    return contact;
  }
  contact.touching = true;
  const Vec3 sticks = inverse * e;
  const double pressed = -n.dot(sticks);
  const Vec3 along = sticks + pressed * n;
  const double size = along.norm();
  if (pressed > 0 && size <= friction * pressed) {
    contact.force = sticks;
    return contact;
  }
  Vec3 d = -n;
  if (size > 0) d += friction / size * along;
  double give = -n.dot(C * d);
  // Why: where pressing along the cone would lift the surface, Coulomb's law has no solution.
  const double least = 0.1 * n.dot(C * n);
  if (give < least) {
    d = -n;
    give = n.dot(C * n);
  }
  contact.force = p / give * d;
  contact.gap = e - C * contact.force;
  contact.gap -= n.dot(contact.gap) * n;
  return contact;
}

}  // namespace palpate::haptic
