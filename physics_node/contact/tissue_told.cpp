// The copy of the tissue that a hand is told at the end of a frame.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/message/vec3.h"
#include "physics_node/contact/bonded_layer.h"
#include "physics_node/contact/half_space.h"
#include "physics_node/contact/secant_stiffness.h"
#include "physics_node/contact/tissue_tool.h"

namespace palpate::physics {
namespace {

// Of what holds modes where their force does not: weight, what a body lies on, other tools, a law that is
// curved. Why: slower than a hand palpates.
constexpr double offset_smoothing = 0.1;  // [s]
constexpr double rest_smoothing = 5e-3;   // of what modes do not tell [s]
// Where a touch begins: of the size of a cell, and of the shape's. Why: a force on one face of a cell is borne as by a
// round patch of this radius (slabs of 8, 16 and 40 mm on what stands, cells of 4 mm, a ball of 5 mm, a first tap of
// 2 mm: peak to 4 %; springs give more than a solid by the factor below, then to 6 %); a stick lies on more than a ball
// does, a flat end on all of it.
constexpr double smallest_of_element = 0.37, smallest_of_spring = 0.48, smallest_of_ball = 0.05,
                 smallest_of_others = 1;
constexpr double springs_give = 1.13;
// Of its size: how far aside a tip still presses what it touched.
constexpr double same_place = 0.2;
// Of its radius: how deep a ball is pressed where modes are compared with what gives in all.
constexpr double usual_depth = 0.2;
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

/// Of a half space, by what stays of a force. A ball lies on more of it the deeper it is; the rest on what bears now.
GrowingContact TissueTool::closed_form(const Touchable& body) const noexcept {
  const Body& tissue = body.moving->body();
  const double E = flow_.lasting() * half_space_modulus(tissue), size = held_.shape.size();
  if (held_.turns())
    return GrowingContact::of_ball(
        E, std::max(smallest_of_others * size, std::sqrt(faces_.area() / std::numbers::pi)), 0);
  const double of_cell = is_of_finite_elements(tissue) ? smallest_of_element : smallest_of_spring;
  return GrowingContact::of_ball(E, std::max(smallest_of_ball * size, of_cell * tissue.spacing()), size);
}

/// omega^2 of what stays: how a mode rests [1/s^2].
double TissueTool::lasting_stiffness(const Touchable& body, std::size_t mode) const noexcept {
  return flow_.lasting() * body.modes.omega2(mode);
}

/// How far modes rest along the normal, by force [m/N].
double TissueTool::modal_compliance(const Touchable& body, const Shapes& psi) const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < body.modes.size(); ++i)
    if (const double along = psi[i].dot(pose_.normal()), stiffness = lasting_stiffness(body, i);
        stiffness > 0)
      sum += along * along / stiffness;
  return sum;
}

/// Of a first touch: what modes do of all that the closed form gives is not left to the rest.
double TissueTool::share_beside_modes(const Touchable& body, const Shapes& psi,
                                      const GrowingContact& law) const noexcept {
  const double usual = usual_depth * held_.shape.size();
  const double gives = is_of_finite_elements(body.moving->body()) || held_.turns() ? 1.0 : springs_give;
  return gives / stiffer_than_deep(body, usual) - modal_compliance(body, psi) / law.slope_at(usual);
}

/// Of a ball at that depth, by what stands below it.
double TissueTool::stiffer_than_deep(const Touchable& body, double depth) const noexcept {
  const auto& shares = body.contact.shares();
  if (held_.turns() || shares.empty()) return 1;
  const auto under = std::ranges::max_element(shares, {}, &MassShare::share);
  const Body& tissue = body.moving->body();
  const double thickness = thickness_below(tissue, under->cell, pose_.normal());
  return bonded_layer(half_space_poisson_ratio(tissue), std::sqrt(held_.shape.size() * depth) / thickness);
}

/// What does not follow the modes is learnt along the normal, and while it goes along that rather than
/// across: where it slides, forces change with the place.
void TissueTool::follow_compliance(const Touchable& body, const Shapes& psi, const GrowingContact& law,
                                   const Told& now) noexcept {
  const Vec3& n = pose_.normal();
  double moved = 0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) moved -= psi[i].dot(n) * (now.q[i] - told_.q[i]);
  if (told_at_ > 0 && now.force > 0 && told_.force > 0 && since_told() > 0) {
    const Vec3 way = now.tip - told_.tip;
    const double in = -way.dot(n);
    if ((way + in * n).norm() <= std::abs(in))
      residual_.follow(law.give(now.stays) - law.give(told_.stays), in - moved, since_told());
  } else if (now.force <= 0 || told_at_ == 0) {
    if (learns_of_ != touched_) {
      first_.begin(share_beside_modes(body, psi, law));
      free_at_.reset();
      learns_of_ = touched_;
    }
    residual_.begin(first_.value());
  }
}

/// How far it has given since the surface was free where it was pressed hardest in this frame, which may hold a
/// whole tap; as long as that is one place, and comes back to that surface.
/// @param way  of the modes now [m]  @param gives  beside them now [m]
void TissueTool::follow_first_touch(const Touchable& body, const Shapes& psi, const GrowingContact& law,
                                    const Vec3& way, double gives) noexcept {
  const Vec3& n = pose_.normal();
  if (free_at_ && told_at_ > 0 && since_told() > 0 && hardest_.force > 0) {
    Vec3 modal = way;
    if (force_ < hardest_.force) {  // not known then: as it rests
      modal.setZero();
      for (std::size_t i = 0; i < body.modes.size(); ++i)
        if (const double stiffness = lasting_stiffness(body, i); stiffness > 0)
          modal -= hardest_.stays * psi[i].dot(n) / stiffness * psi[i];
    }
    const Vec3 given = hardest_.tip - modal - *free_at_;
    const double in = -given.dot(n);
    const bool aside = (given + in * n).norm() > same_place * held_.shape.size();
    if (aside || !remembers_rest(body.moving->body()))
      free_at_.reset();
    else
      first_.follow(law.give(hardest_.stays), in, since_told());
  }
  if (force_ <= 0) free_at_ = tip_now() - way + gives * n;
}

/// A copy that stands must not move: told is how far modes are out from where they would rest without the
/// tool's force, q - o with o the slow part of q - psi . F_e / omega^2.
void TissueTool::take_offsets(const Touchable& body, const Shapes& psi, Modal& q) noexcept {
  const Vec3& n = pose_.normal();
  const double pressed = -on_tissue_.dot(n);
  const Vec3 force = pressed > 0 ? Vec3(flow_.staying() / pressed * on_tissue_) : Vec3(-flow_.staying() * n);
  const double part = told_at_ > 0 ? -std::expm1(-since_told() / offset_smoothing) : 1.0;
  for (std::size_t i = 0; i < body.modes.size(); ++i) {
    const double stiffness = lasting_stiffness(body, i);
    const double rests = stiffness > 0 ? psi[i].dot(force) / stiffness : 0.0;
    offsets_[i] += part * (q[i] - rests - offsets_[i]);
    q[i] -= offsets_[i];
  }
}

/// Branches beside the modes are as stiff as these are all together along the normal, so they relax as far as what the
/// contact bears.
void TissueTool::tell_flow(const Touchable& body, const Shapes& psi, TouchedTissue& tissue) const noexcept {
  tissue.n_branches = told_branches_;
  if (told_branches_ == 0) return;
  const double modal = modal_compliance(body, psi);
  const auto flows = flow_.branches();
  for (std::size_t j = 0; j < told_branches_; ++j) {
    BranchOfTissue& branch = tissue.branches[j];
    branch = {};  // one that nothing moves
    if (j >= flows.size()) continue;
    branch.time = flows[j].time;
    branch.share = std::min(flows[j].share, most_flow);
    branch.force = flows[j].force;
    // Modes have the body's dampers of their own.
    if (flows[j].viscous || !(modal > 0)) continue;
    branch.stiffness = std::min(flows[j].share / modal, rigid_stiffness);
    branch.place = std::min(flows[j].force * modal, farthest_hand);
  }
}

void TissueTool::tell(TouchedTissue& tissue) noexcept {
  Touchable& body = *bodies_[touched_];
  const Vec3 n = pose_.normal();
  const Shapes psi = find_shapes(body);
  Told now;
  now.tip = tip_now();
  now.force = std::max(0.0, -on_tissue_.dot(n));
  now.stays = flow_.staying();
  body.modes.measure(*body.moving, now.q, now.w);
  const GrowingContact law = closed_form(body);
  follow_compliance(body, psi, law, now);
  Modal q = now.q;
  take_offsets(body, psi, q);
  GrowingContact gives = law;
  gives.compliance = std::min(residual_.value() * gives.compliance, most_compliance);
  const double across = std::min(across_to_along * gives.slope(now.stays), most_compliance);
  const Vec3& force = on_tissue_;

  Vec3 way = Vec3::Zero();
  for (std::size_t i = 0; i < body.modes.size(); ++i) way += q[i] * psi[i];
  const double given = gives.give(now.stays);
  follow_first_touch(body, psi, law, way, given);
  Vec3 rest = now.tip - way - across * (force + now.force * n) + given * n;
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
  tissue.residual = gives.compliance;
  tissue.growth = gives.growth;
  tissue.residual_across = across;
  tissue.rest = array(rest_);
  tissue.force = array(force);
  tissue.n_modes = told_modes_;
  for (std::size_t i = 0; i < told_modes_; ++i) {
    tissue.modes[i] = {};  // one that nothing moves
    if (i < body.modes.size())
      tissue.modes[i] = {array(psi[i]), lasting_stiffness(body, i), body.modes.damping(i), q[i], now.w[i]};
  }
  tell_flow(body, psi, tissue);
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
