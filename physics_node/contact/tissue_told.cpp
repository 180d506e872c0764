// The copy of the tissue that a hand is told at the end of a frame.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/message/vec3.h"
#include "physics_node/contact/secant_stiffness.h"
#include "physics_node/contact/tissue_tool.h"

namespace palpate::physics {
namespace {

// Of what holds modes where their force does not: weight, what a body lies on, other tools, a law that is
// curved. Why: slower than a hand palpates.
constexpr double offset_smoothing = 0.1;  // [s]
constexpr double rest_smoothing = 5e-3;   // of what modes do not tell [s]
// Of the shape's size: where a touch begins. A stick lies on more than a ball does, a flat end on all of it.
constexpr double smallest_of_ball = 0.25, smallest_of_others = 1;
// Of a rigid patch on a half space, across its plane to along its normal: (2 - nu) / (2 - 2 nu), nu = 1/3.
constexpr double across_to_along = 1.25;

}  // namespace

/// Along the normal by what the pressure does on a mode, whose forces lean with the sphere; across it by the
/// proportions of the pressure.
TissueTool::Shapes TissueTool::find_shapes(const Touchable& body) const noexcept {
  Shapes psi;
  const Vec3 n = pose_.normal();
  const double pressed = -on_tissue_.dot(n);
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    psi[i].setZero();
    if (!(pressed > 0)) {
      for (const MassShare& share : body.contact.shares())
        psi[i] += share.share * body.modes.shape(i, share.cell);
      continue;
    }
    double load = 0;
    for (const NodalForce& nodal : forces()) {
      const Vec3 shape = body.modes.shape(i, nodal.cell);
      psi[i] -= nodal.force.dot(n) / pressed * shape;
      load += nodal.force.dot(shape);
    }
    const Vec3 across = psi[i] - psi[i].dot(n) * n;
    psi[i] = across + (across.dot(on_tissue_) - load) / pressed * n;
  }
  return psi;
}

/// Of a half space under what bears: 2 E a / (1 - nu^2) [N/m].
double TissueTool::stiffness_of_patch(const Touchable& body) const noexcept {
  const double a = std::max((held_.turns() ? smallest_of_others : smallest_of_ball) * held_.shape.size(),
                            std::sqrt(faces_.area() / std::numbers::pi));
  return half_space_stiffness(body.moving->body(), a);
}

/// What does not follow the modes is learnt along the normal, and while it goes along that rather than
/// across: where it slides, forces change with the place.
void TissueTool::follow_compliance(const Touchable& body, const Shapes& psi, const Told& now) noexcept {
  const Vec3& n = pose_.normal();
  const double k = stiffness_of_patch(body);
  double moved = 0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) moved -= psi[i].dot(n) * (now.q[i] - told_.q[i]);
  if (told_at_ > 0 && now.force > 0 && told_.force > 0 && since_told() > 0) {
    const Vec3 way = now.tip - told_.tip;
    const double in = -way.dot(n);
    if ((way + in * n).norm() <= std::abs(in))
      residual_.follow(k, now.force - told_.force, in - moved, since_told());
  } else if (now.force <= 0 || told_at_ == 0) {
    residual_.begin(k);
  }
}

/// A copy that stands must not move: told is how far modes are out from where they would rest without the
/// tool's force, q - o with o the slow part of q - psi . F / omega^2.
void TissueTool::take_offsets(const Touchable& body, const Shapes& psi, Modal& q) noexcept {
  const Vec3& force = on_tissue_;
  const double part = told_at_ > 0 ? -std::expm1(-since_told() / offset_smoothing) : 1.0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    const double stiffness = body.modes.omega2(i);
    const double rests = stiffness > 0 ? psi[i].dot(force) / stiffness : 0.0;
    offsets_[i] += part * (q[i] - rests - offsets_[i]);
    q[i] -= offsets_[i];
  }
}

void TissueTool::tell(TouchedTissue& tissue) noexcept {
  Touchable& body = *bodies_[touched_];
  const Vec3 n = pose_.normal();
  const Shapes psi = find_shapes(body);
  Told now;
  now.tip = tip_now();
  now.force = -on_tissue_.dot(n);
  body.modes.measure(*body.moving, now.q, now.w);
  follow_compliance(body, psi, now);
  Modal q = now.q;
  take_offsets(body, psi, q);
  const double residual = std::min(residual_.value(), most_compliance);
  const double across = std::min(across_to_along * residual, most_compliance);
  const Vec3& force = on_tissue_;

  Vec3 rest = now.tip - across * force - (residual - across) * force.dot(n) * n;
  for (std::size_t i = 0; i < body.modes.size(); ++i) rest -= q[i] * psi[i];
  if (told_at_ > 0 && now.force > 0 && told_.force > 0) {
    // What has slid has done so at once; the rest is what modes do not tell.
    const Vec3 slid = rubbing_.sticks() ? rubbing_.take_slid() : Vec3(rest - rest_);
    rest_ += slid - slid.dot(n) * n;
    rest_ -= std::expm1(-since_told() / rest_smoothing) * (rest - rest_);
  } else {
    rest_ = rest;
    rubbing_.take_slid();
  }
  // In a frame without a sample the hand stands: what changes then is learnt with the next.
  if (told_at_ == 0 || since_told() > 0) told_ = now;
  told_at_ = play_.sample();

  tissue.sample = told_at_;
  tissue.normal = array(n);
  tissue.arm = array(arm_);
  tissue.residual = residual;
  tissue.residual_across = across;
  tissue.rest = array(rest_);
  tissue.force = array(force);
  tissue.n_modes = told_modes_;
  for (std::size_t i = 0; i < told_modes_; ++i) {
    tissue.modes[i] = {};  // one that nothing moves
    if (i < body.modes.size())
      tissue.modes[i] = {array(psi[i]), body.modes.omega2(i), body.modes.damping(i), q[i], now.w[i]};
  }
  tissue.n_branches = 0;
}

void TissueTool::write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept {
  begin_patch(patch, frame, now_ns);
  patch.n_tissues = found_ && play_.sample() > 0 ? 1 : 0;
  if (patch.n_tissues == 0) {
    told_at_ = 0;
    return;
  }
  tell(patch.tissues[0]);
}

}  // namespace palpate::physics
