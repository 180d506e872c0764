#include "haptic_node/tissue/point_touch.h"

#include <algorithm>
#include <cmath>

#include "common/message/vec3.h"

namespace palpate::haptic {
namespace {

TissueAnswer answer_of(const TouchedTissue& told) noexcept {
  TissueAnswer answer;
  answer.stamp = told.sample;
  TissueModel& model = answer.model;
  TissueState& state = answer.state;
  model.n_modes = told.n_modes;
  for (std::uint32_t i = 0; i < told.n_modes; ++i) {
    const ModeOfTissue& mode = told.modes[i];
    model.modes[i] = {mode.phi, mode.stiffness, mode.damping};
    state.q[i] = mode.q, state.w[i] = mode.w;
  }
  model.n_branches = told.n_branches;
  for (std::uint32_t j = 0; j < told.n_branches; ++j) {
    model.branches[j] = {told.branches[j].stiffness, told.branches[j].time};
    state.p[j] = told.branches[j].place;
  }
  model.residual = told.residual;
  state.rest = told.rest;
  state.force = told.force;
  return answer;
}

}  // namespace

PointTouch::PointTouch(const TouchSettings& settings) noexcept
    : limit_(settings.force_limit), tips_(settings.period), touch_(settings) {}

void PointTouch::turn_to(const Vec3& point, const Vec3& normal) noexcept {
  const Vec3 newest = tips_.newest() > 0 ? tips_.at(tips_.newest()).x : point;
  const double before = depth(newest);
  point_ = point;
  normal_ = normal;
  touch_.turn(
      tips_,
      [this](const TipSample& tip) {
        return HandSample{depth(tip.x), -normal_.dot(tip.v)};
      },
      known_ ? depth(newest) - before : 0.0);
  known_ = true;
}

void PointTouch::take(const ContactPatch& patch) noexcept {
  if (patch.n_tissues == 0) {
    known_ = false;
    return;
  }
  const TouchedTissue& told = patch.tissues[0];
  const TissueAnswer answer = answer_of(told);
  if (!is_sound(answer, answer.tool)) return;
  const bool foretold = known_ && touch_.knows_shadow();
  if (const Vec3 point = vec(told.point), normal = vec(told.normal).normalized();
      !known_ || point != point_ || normal != normal_)
    turn_to(point, normal);
  surface_ = modal_surface(answer.model, answer.state) + told.residual * told.force;
  const double before = touch_.shadow_copy().state.force;
  if (!touch_.take(answer) || !foretold) return;
  const double now = touch_.shadow_copy().state.force;
  off2_ += (now - before) * (now - before);
  force2_ += now * now;
}

Vec3 PointTouch::tick(const Vec3& x, double gain) noexcept {
  tips_.add(x);
  given_ = touch_.tick(depth(x), known_ ? gain : 0.0);
  return given_ * normal_;
}

void PointTouch::sent(const Vec3& force) noexcept {
  const double along = force.dot(normal_);
  touch_.sent(along);
  felt_ = given_ > 0 ? Vec3(along / given_ * std::min(touch_.felt(), limit_) * normal_) : Vec3(Vec3::Zero());
}

double PointTouch::model_error() const noexcept { return force2_ > 0 ? std::sqrt(off2_ / force2_) : 0; }

}  // namespace palpate::haptic
