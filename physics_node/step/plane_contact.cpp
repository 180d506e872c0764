#include "physics_node/step/plane_contact.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr int most_sweeps =
    64;  // where a mass lies in a corner; each leaves the cosine squared between two walls

template <class Visit>
void for_planes(PlaneSet set, std::span<const Plane> planes, const Visit& visit) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((set >> k & 1) != 0) visit(k, planes[k]);
}

}  // namespace

KeptOut keep_out(const Vec3& x, const Vec3& D, std::span<const Plane> planes, double near) noexcept {
  KeptOut kept{.D = D};
  const auto room = [&](const Plane& plane) { return room_left(plane, x, kept.D); };
  bool moved = true;
  for (int sweep = 0; moved && sweep < most_sweeps; ++sweep) {
    moved = false;
    for (const Plane& plane : planes) {
      const double less = -room(plane);
      if (!(less > 1e-6 * near)) continue;
      moved = planes.size() > 1;
      kept.D += less * plane.n;
    }
  }
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (room(planes[k]) <= near) kept.at |= PlaneSet{1} << k;
  if (kept.at != 0) kept.pushed = (kept.D - D).norm();
  return kept;
}

PlaneSet planes_that_push(PlaneSet at, const Vec3& force, std::span<const Plane> planes) noexcept {
  std::array<double, 32> l{};
  Vec3 left = force;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool changed = false;
    for_planes(at, planes, [&](std::size_t k, const Plane& plane) {
      const double next = std::max(0.0, l[k] - plane.n.dot(left));
      changed = changed || std::abs(next - l[k]) > 1e-12 * next;
      left += (next - l[k]) * plane.n;
      l[k] = next;
    });
    if (!changed) break;
  }
  PlaneSet push = 0;
  for_planes(at, planes, [&](std::size_t k, const Plane&) {
    if (l[k] > 0) push |= PlaneSet{1} << k;
  });
  return push;
}

Vec3 HeldDirections::part_of(const Vec3& v) const noexcept {
  Vec3 part = Vec3::Zero();
  for (int k = 0; k < count; ++k)
    part += n[static_cast<std::size_t>(k)].dot(v) * n[static_cast<std::size_t>(k)];
  return part;
}

HeldDirections directions_of(PlaneSet set, std::span<const Plane> planes) noexcept {
  HeldDirections held;
  for_planes(set, planes, [&](std::size_t, const Plane& plane) {
    const Vec3 other = plane.n - held.part_of(plane.n);
    const double length = other.norm();
    if (held.count == 3 || length < 1e-6) return;  // as another one has it already
    held.n[static_cast<std::size_t>(held.count++)] = other / length;
  });
  return held;
}

PlaneImpact impact_of(double mass, const Vec3& v, const Vec3& D, const Vec3& R, const HeldDirections& held,
                      double dt, double e, double fastest) noexcept {
  PlaneImpact sum;
  for (int k = 0; k < held.count; ++k) {
    const Vec3& n = held.n[static_cast<std::size_t>(k)];
    const double V = -n.dot(v), D_n = n.dot(D), R_n = n.dot(R), now = D_n / dt;
    const double q = 0.5 * mass * V * V + (mass * (now + V) / dt - R_n) * D_n;
    double after = now, contact = 0;
    if (V > 0) {
      after = std::max(now, std::min(fastest, e * std::sqrt(2 * std::max(q, 0.0) / mass)));
      contact = (1 - e * e) * std::max(q, 0.0);
    }
    sum.dv += (after - now) * n;
    sum.contact += contact;
    sum.numerical -= R_n * D_n + 0.5 * mass * (after * after - now * now) + contact;
  }
  return sum;
}

}  // namespace palpate::physics
