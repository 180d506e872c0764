#include "physics_node/contact/stick_spring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/message/messages.h"
#include "physics_node/contact/half_space.h"

namespace palpate::physics {
namespace {

constexpr double time = 0.150;    // in which the place of the force is learnt [s]
constexpr double light = 0.05;    // force that says as much of it as what was known before [N]
constexpr double upright = 1e-2;  // of the axis, in the plane: less makes no moment

}  // namespace

StickSpring::StickSpring(const std::vector<TouchableBody>& bodies, double radius) {
  for (const TouchableBody& body : bodies) surfaces_.emplace_back(*body.surface, *body.moving, radius);
}

void StickSpring::reset() noexcept {
  spring_.reset();
  K_o_ = {};
  shift_ = 0;
}

void StickSpring::look(const Stick& stick, double t) noexcept {
  for (StickSurface& surface : surfaces_) surface.look(stick, t);
}

/// Stiffness and place of the force, by force and indentation.
void StickSpring::learn(const StickPlane& plane, const Stick& stick, const Vec6& felt, double dt) noexcept {
  const Vec3 force = felt.head<3>(), moment = felt.tail<3>();
  const Body& body = surfaces_[body_].body();
  const double F = std::max(0.0, force.dot(plane.normal));
  const double indentation = remembers_rest(body) ? -plane.gap : plane.sunk;
  if (!K_o_.begun() || indentation <= 0) {
    K_o_.begin(half_space_stiffness(body, std::sqrt(plane.area / std::numbers::pi)));
    shift_ = 0;
    return;
  }
  K_o_.follow(F, indentation, dt);
  const Vec3 in_plane = stick.D - stick.D.dot(plane.normal) * plane.normal;
  if (F <= 0 || in_plane.norm() < upright * stick.D.norm()) return;
  const double c = plane.normal.cross(moment).dot(in_plane) / (F * in_plane.squaredNorm());
  const double part = (1 - std::exp(-dt / time)) * F / (F + light);
  shift_ += part * (std::clamp(c, 0.0, 1.0) - plane.along - shift_);
}

void StickSpring::follow(const Stick& stick, const Vec6& felt, double dt) noexcept {
  spring_.reset();
  StickPlane plane;
  for (std::size_t b = 0; b < surfaces_.size(); ++b) {
    const StickPlane one = surfaces_[b].plane(stick, remembers_rest(surfaces_[b].body()));
    if (!one.found || (plane.found && plane.gap <= one.gap)) continue;
    plane = one;
    body_ = b;
  }
  if (!plane.found) return;
  learn(plane, stick, felt, dt);
  const double moves = 1 - plane.held;
  NortonSpring spring;
  spring.normal = plane.normal;
  spring.stiffness = std::min(K_o_.value() / (moves * moves), rigid_stiffness);
  spring.gap = plane.gap;
  // A surface that is met where it is now lay higher by what the force has pushed it in.
  if (!remembers_rest(surfaces_[body_].body()))
    spring.gap -= std::max(0.0, felt.head<3>().dot(plane.normal)) / spring.stiffness;
  spring.arm = std::clamp(plane.along + shift_, 0.0, 1.0) * stick.D;
  spring.spread = plane.spread * stick.D;
  spring_ = spring;
}

}  // namespace palpate::physics
