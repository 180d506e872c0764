#include "haptic_node/contact/local_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/message/vec3.h"
#include "haptic_node/contact/facet_geometry.h"

namespace palpate::haptic {
namespace {

constexpr double start_lateral = 1e-3;   // beside a facet, within which contact with it may begin [m]
constexpr double outran_lateral = 5e-3;  // beside all facets, beyond which the patch says nothing [m]
constexpr double force_rate =
    80.0;  // most that moving planes change the force [N/s]: 0.08 N in a tick of 1 ms
constexpr double inside_tolerance = 1e-6;  // [m]
constexpr double crossed_tolerance =
    2e-4;                            // how far below a plane a proxy may be and still count as outside [m]
constexpr double forget_gap = 5e-4;  // above a second plane, beyond which it is dropped [m]

}  // namespace

void LocalContact::take(const ContactPatch& patch, double period) noexcept {
  if (patch.contact_set != patch_.contact_set || patch.n_facets != patch_.n_facets) facet_ = no_facet;
  patch_ = patch;
  remaining_ = period;
}

bool LocalContact::penetrated(const Vec3& x) const noexcept {
  const std::uint32_t nearest = nearest_facet(patch_, x);
  if (nearest == no_facet) return false;
  const FacetPosition position = locate(x, patch_.facets[nearest]);
  return position.gap < -inside_tolerance && position.lateral <= start_lateral;
}

Projection LocalContact::project(const Vec3& x) const noexcept {
  std::array<HalfSpace, most> spaces;
  for (std::size_t i = 0; i < n_; ++i) spaces[i] = planes_[i].half_space();
  // Planes that leave no room: the last ones to come are not minded. One alone always leaves some.
  for (std::size_t n = n_; n > 1; --n) {
    const Projection projection = project_out({spaces.data(), n}, x);
    if (projection.feasible) return projection;
  }
  return project_out({spaces.data(), std::min<std::size_t>(n_, 1)}, x);
}

PlaneTarget LocalContact::target_of(const PatchFacet& facet, const Vec3& x) const noexcept {
  return {vec(facet.normal), facet_gap(x, facet),
          stiffness_ * facet.stiffness / (stiffness_ + facet.stiffness)};
}

/// Nothing is touched: the plane of the nearest facet stands ready. If the patch has put it beyond the hand, it
/// starts at the hand and may then push as fast as the tank pays.
void LocalContact::approach(const Vec3& x, double fraction, double force_step) noexcept {
  facet_ = nearest_facet(patch_, x);
  if (facet_ == no_facet || locate(x, patch_.facets[facet_]).lateral > start_lateral) {
    n_ = 0;
    return;
  }
  PlaneTarget start = target_of(patch_.facets[facet_], x);
  const PlaneTarget target = start;
  if (start.gap < 0) start.gap = 0;
  planes_[0].place(start, x);
  n_ = 1;
  if (target.gap < 0) planes_[0].follow(target, x, 0.0, fraction, force_step, 1.0, tank_);
}

/// @return true if the proxy left the neighbourhood that the patch covers
bool LocalContact::follow_first(const Vec3& x, const Vec3& proxy, double pressed, double fraction,
                                double force_step, double share) noexcept {
  PlaneTarget target{planes_[0].normal(), 1e-3,
                     planes_[0].stiffness()};  // away, if nothing is below any more
  facet_ = facet_under_proxy(patch_, proxy, facet_, planes_[0].normal());
  const bool outran = facet_ == no_facet || locate(proxy, patch_.facets[facet_]).lateral > outran_lateral;
  if (!outran) target = target_of(patch_.facets[facet_], x);
  planes_[0].follow(target, x, pressed, fraction, force_step, share, tank_);
  return outran;
}

void LocalContact::follow_others(const Vec3& x, const Vec3& proxy, const Projection& before, double fraction,
                                 double force_step, double share) noexcept {
  std::size_t kept = 1;
  for (std::size_t i = 1; i < n_; ++i) {
    const std::uint32_t facet = facet_alike(patch_, proxy, planes_[i].normal(), start_lateral);
    if (facet == no_facet || planes_[i].gap(x) > forget_gap ||
        same_side(planes_[i].normal(), planes_[0].normal()))
      continue;
    planes_[i].follow(target_of(patch_.facets[facet], x), x, pressed(before, i), fraction, force_step, share,
                      tank_);
    planes_[kept++] = planes_[i];
  }
  n_ = kept;
}

/// Other sides that the way from proxy to hand crosses. They begin where the hand was a tick ago.
void LocalContact::add_crossed(const Vec3& x, const Vec3& proxy) noexcept {
  const double moved = (x - last_x_).norm();
  for (std::uint32_t i = 0; i < patch_.n_facets && n_ < most; ++i) {
    const PatchFacet& facet = patch_.facets[i];
    const Vec3 normal = vec(facet.normal);
    bool known = false;
    for (std::size_t j = 0; j < n_; ++j) known = known || same_side(planes_[j].normal(), normal);
    if (known) continue;
    const double at_hand = facet_gap(x, facet);
    const double at_proxy = facet_gap(proxy, facet);
    if (at_hand >= 0 || at_proxy < -crossed_tolerance) continue;
    const double s = std::max(at_proxy, 0.0) / (std::max(at_proxy, 0.0) - at_hand);
    if (locate(proxy + s * (x - proxy), facet).lateral > start_lateral) continue;
    PlaneTarget start = target_of(facet, x);
    start.gap = std::max(start.gap, -moved);
    planes_[n_++].place(start, x);
  }
}

ContactResult LocalContact::felt(const Vec3& x, const Vec3& v) const noexcept {
  ContactResult result;
  const Projection now = project(x);
  for (std::size_t i = 0; i < n_; ++i) {
    if (now.push[i] <= 0) continue;
    // Damping is at most half the spring on the way in, so that force starts gently, and never pulls.
    const double spring = planes_[i].stiffness() * now.push[i];
    const double damper = std::clamp(-damping_ * v.dot(planes_[i].normal()), -spring, 0.5 * spring);
    result.force += (spring + damper) * planes_[i].normal();
    result.stored += 0.5 * spring * now.push[i];
    result.n_planes += 1;
  }
  result.depth = (now.point - x).norm();
  result.proxy = x + result.force / stiffness_;
  return result;
}

/// Friction on top of what the planes do.
void LocalContact::rub(const Vec3& x, ContactResult& result) noexcept {
  result.force += friction_.tick(x, result.force, n_ > 0 ? planes_[0].stiffness() : 0.0);
  result.stored += friction_.stored();
  result.proxy = x + result.force / stiffness_;
}

ContactResult LocalContact::tick(const Vec3& x, const Vec3& v, double dt, double share) noexcept {
  const double fraction = remaining_ <= dt ? 1.0 : dt / remaining_;
  remaining_ = std::max(0.0, remaining_ - dt);
  const double force_step = force_rate * dt;
  bool outran = false;

  if (patch_.n_facets == 0) n_ = 0;
  const Projection before = project(x);  // the hand has moved, the planes have not
  Vec3 spring = Vec3::Zero();
  for (std::size_t i = 0; i < n_; ++i)
    spring += planes_[i].stiffness() * before.push[i] * planes_[i].normal();
  const bool touching = spring.squaredNorm() > 0;
  if (!touching) {
    if (patch_.n_facets > 0) approach(x, fraction, force_step);
  } else {
    const Vec3 proxy = x + spring / stiffness_;
    outran = follow_first(x, proxy, pressed(before, 0), fraction, force_step, share);
    follow_others(x, proxy, before, fraction, force_step, share);
    if (!outran) add_crossed(x, proxy);
  }
  last_x_ = x;

  ContactResult result = felt(x, v);
  if (friction_.applies()) rub(x, result);
  result.outran = outran;
  tank_.pass(dt, result.n_planes > 0);
  return result;
}

void LocalContact::weaken(const Vec3& x, double keep) noexcept {
  const Projection now = project(x);
  for (std::size_t i = 0; i < n_; ++i) {
    const double depth = std::max(0.0, -planes_[i].gap(x));
    planes_[i].retreat(std::max(depth - keep * now.push[i], 0.0));
  }
}

}  // namespace palpate::haptic
