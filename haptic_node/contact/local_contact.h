#pragma once
// What a point tool feels of the facets in the newest patch, at the rate of the hand.
//
// Each facet stands for the tissue behind it as a plane at zero contact force with a stiffness K_o (a Norton
// equivalent). Hand spring K and tissue are in series, so that with the tip x a depth d inside that plane
//
//   F = (K K_o / (K + K_o)) d n - damping,    proxy = x + F / K  (the point where the tool rests on the surface)
//
// One plane follows the facet under the proxy; up to two more are other sides that the proxy ran into (a concave
// corner). With friction the proxy sticks within a cone (friction.h). A facet counts only when the way from proxy to hand crosses it, so that convex edges are not felt from
// outside. Every contact begins at zero force; afterwards planes move as TrackedPlane allows.
// Source: Astley & Hayward 1998 (Norton equivalents); Zilles & Salisbury 1995 (which facets count).
// Deviation: Mendoza & Laugier let every plane with d < 0 push; beside a convex edge that is a ghost force.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "common/math/vec3.h"
#include "common/message/messages.h"
#include "haptic_node/contact/contact_result.h"
#include "haptic_node/contact/facet_choice.h"
#include "haptic_node/contact/friction.h"
#include "haptic_node/contact/tracked_plane.h"
#include "haptic_node/contact/work_tank.h"

namespace palpate::haptic {

class LocalContact {
 public:
  /// @param stiffness  of the spring between hand and proxy, K [N/m]
  /// @param damping    B [N s/m]
  /// @param limit      force beyond which springs do not push harder [N]; planes then do no more work than that
  /// @param friction   Coulomb's coefficient; 0: the surface is slippery
  LocalContact(double stiffness, double damping, double limit = std::numeric_limits<double>::infinity(),
               double friction = 0) noexcept
      : stiffness_(stiffness), damping_(damping), limit_(limit), friction_(friction) {}

  /// A new patch; its planes are reached after about `period` seconds. It must have passed PatchWatch.
  void take(const ContactPatch& patch, double period) noexcept;

  /// True if x is inside the tissue, by the newest patch.
  bool penetrated(const Vec3& x) const noexcept;

  /// Contract: real time.
  /// @param x, v   tip [m], its smoothed velocity [m/s]
  /// @param share  of this force that reached the hand in the last tick, 0..1: planes do that much of their work
  ContactResult tick(const Vec3& x, const Vec3& v, double dt, double share = 1) noexcept;

  /// Planes move away until the spring force is `keep` (0..1) of what it was at x.
  void weaken(const Vec3& x, double keep) noexcept;

  /// Forgets all planes: the next contact begins at zero force.
  void release() noexcept {
    n_ = 0;
    friction_.release();
  }

  /// Springs that grow stiffer do work as moving planes do. @return what may be done of `work` [J], booked
  double pay(double work) noexcept { return tank_.pay(work); }

  /// Work of moving planes on the hand since the start [J].
  double plane_work() const noexcept { return tank_.booked(); }

 private:
  static constexpr std::size_t most = 3;

  Projection project(const Vec3& x) const noexcept;
  /// How far plane i is pressed, as far as its force goes [m].
  double pressed(const Projection& at, std::size_t i) const noexcept {
    return std::min(at.push[i], limit_ / planes_[i].stiffness());
  }
  PlaneTarget target_of(const PatchFacet& facet, const Vec3& x) const noexcept;
  void approach(const Vec3& x, double fraction, double force_step) noexcept;
  bool follow_first(const Vec3& x, const Vec3& proxy, double pressed, double fraction, double force_step,
                    double share) noexcept;
  void follow_others(const Vec3& x, const Vec3& proxy, const Projection& before, double fraction,
                     double force_step, double share) noexcept;
  void add_crossed(const Vec3& x, const Vec3& proxy) noexcept;
  ContactResult felt(const Vec3& x, const Vec3& v) const noexcept;
  void rub(const Vec3& x, ContactResult& result) noexcept;

  double stiffness_;
  double damping_;
  double limit_;
  ContactPatch patch_{};
  double remaining_ = 0;  // until the planes of the patch are reached [s]
  std::array<TrackedPlane, most> planes_{};
  std::size_t n_ = 0;
  std::uint32_t facet_ = no_facet;  // of plane 0, in patch_
  Vec3 last_x_ = Vec3::Zero();
  Friction friction_;
  WorkTank tank_;
};

}  // namespace palpate::haptic
