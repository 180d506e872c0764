#include "haptic_node/tissue/point_touch.h"

#include <algorithm>
#include <cmath>

#include "common/message/vec3.h"

namespace palpate::haptic {
namespace {

TissueAnswer answer_of(const TouchedTissue& told, double friction) noexcept {
  TissueAnswer answer;
  answer.stamp = told.sample;
  answer.arm = vec(told.arm);
  TissueModel& model = answer.model;
  TissueState& state = answer.state;
  model.normal = vec(told.normal);
  model.friction = friction;
  model.n_modes = std::min<std::uint32_t>(told.n_modes, TissueModel::most_modes);
  for (std::uint32_t i = 0; i < model.n_modes; ++i) {
    const ModeOfTissue& mode = told.modes[i];
    model.modes[i] = {vec(mode.psi), mode.stiffness, mode.damping};
    state.q[i] = mode.q, state.w[i] = mode.w;
  }
  model.n_branches = std::min<std::uint32_t>(told.n_branches, TissueModel::most_branches);
  for (std::uint32_t j = 0; j < model.n_branches; ++j) {
    const BranchOfTissue& branch = told.branches[j];
    model.branches[j] = {branch.stiffness, branch.time, branch.share};
    state.p[j] = branch.place, state.f[j] = branch.force;
  }
  model.residual = told.residual;
  model.growth = told.growth;
  model.residual_across = told.residual_across;
  state.rest = vec(told.rest) + answer.arm;
  state.force = vec(told.force);
  return answer;
}

}  // namespace

void PointTouch::take(const ContactPatch& patch) noexcept {
  if (patch.n_tissues == 0) {
    known_ = false;
    return;
  }
  const TissueAnswer answer = answer_of(patch.tissues[0], friction_);
  if (!is_sound(answer, answer.tool)) return;
  const bool foretold = known_ && touch_.knows_shadow();
  known_ = true;
  normal_ = answer.model.normal;
  arm_ = answer.arm;
  surface_ = modal_surface(answer.model, answer.state) + residual_way(answer.model, answer.state);
  const Vec3 before = touch_.shadow_copy().state.force;
  if (!touch_.take(answer) || !foretold) return;
  const Vec3& now = touch_.shadow_copy().state.force;
  off2_ += (now - before).squaredNorm();
  force2_ += now.squaredNorm();
}

double PointTouch::model_error() const noexcept { return force2_ > 0 ? std::sqrt(off2_ / force2_) : 0; }

}  // namespace palpate::haptic
