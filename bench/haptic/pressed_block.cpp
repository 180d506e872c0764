#include "bench/haptic/pressed_block.h"

#include <algorithm>
#include <cmath>

namespace palpate::bench {

using haptic::SurfacePlace;
using haptic::SurfaceStep;

/// Spring and damper on the real surface, as it is now; what slides moves xi.
Vec3 PressedBlock::press(const haptic::TipSample& tip) {
  constexpr double last = BlockModel::side - 2.0;
  for (int move = 0;; ++move) {
    const TissueBlock::Point p = tissue_.point(xi_);
    const Vec3& n = p.normal;
    const Vec3 stretch = tip.x - p.at;
    const double depth = -n.dot(stretch);
    haptic::SurfacePoint along;
    along.tangents = p.tangents;
    Vec3 slid = stretch + depth * n, force = Vec3::Zero();
    double share = 1;
    if (depth > 0) {
      const Vec3 e = stretch + spring_.damping / spring_.stiffness * n.dot(tip.v - p.v) * n;
      const haptic::FrictionContact contact =
          haptic::solve_contact(haptic::Mat3::Identity() / spring_.stiffness, e, n, friction_);
      force = contact.force;
      slid = contact.gap;
      share = SurfaceStep::share_moved;
      const double pressed = -n.dot(force),
                   most = (1 + haptic::ContactSpring::most_damping) * spring_.stiffness * depth;
      if (pressed > most) force *= most / pressed;
    }
    if (move == SurfaceStep::moves) return force;
    const SurfacePlace next = xi_ + share * along.places_along(slid);
    xi_ = SurfacePlace(std::clamp(next.x(), 1.0, last), std::clamp(next.y(), 1.0, last));
  }
}

void PressedBlock::play(const haptic::TipSample& a, const haptic::TipSample& b) {
  const int steps = static_cast<int>(std::lround(sample_time / TissueBlock::step));
  for (int i = 0; i < steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const Vec3 force = press({a.x + s * (b.x - a.x), a.v + s * (b.v - a.v)});
    tissue_.advance(xi_, force);
  }
  last_ = b;
  force_ = press(b);
}

void PressedBlock::frame(const TipSamples* hand) {
  if (hand == nullptr || hand->newest <= stamp_) return;
  const std::uint64_t first = hand->newest - hand->samples.size() + 1;
  if (stamp_ == 0) last_ = hand->samples.front();
  stamp_ = std::max(stamp_, first - 1);
  borne_.resize(hand->newest + 1, Vec3::Zero());
  while (stamp_ < hand->newest) {
    play(last_, hand->samples[stamp_ + 1 - first]);
    borne_[++stamp_] = force_;
  }
}

/// Where the middle of the patch is to be: a tip that slides will be there when it is told.
SurfacePlace PressedBlock::ahead() const {
  constexpr double time = 0.1, most = 1.5;  // [s], [nodes]
  const SurfacePlace lead = time / BlockModel::distance * last_.v.head<2>();
  return xi_ + SurfacePlace(std::clamp(lead.x(), -most, most), std::clamp(lead.y(), -most, most));
}

/// The rest is low-passed from one answer to the next.
std::shared_ptr<const haptic::SurfaceAnswer> PressedBlock::answer(std::uint64_t tick) {
  auto answer = std::make_shared<haptic::SurfaceAnswer>();
  answer->tick = tick;
  answer->stamp = stamp_;
  answer->model = BlockModel::get().patch(ahead(), modes_, friction_);
  haptic::SurfaceModel& model = answer->model;
  if (!error_.residual)
    for (auto& c : model.residual) c.fill(0);
  haptic::SurfaceState& state = answer->state;
  for (std::uint32_t i = 0; i < modes_; ++i) state.q[i] = tissue_.mode(i), state.w[i] = tissue_.mode_speed(i);
  state.xi = xi_;
  state.force = force_;
  if (error_.frozen) {
    const haptic::SurfacePoint here = haptic::surface_point(model, state.q, Vec3::Zero(), xi_, Vec3::Zero());
    const haptic::Mat3& R = here.residual;
    for (auto& node : model.nodes) node.shapes = here.psi;
    for (auto& c : model.residual) c = {R(0, 0), R(1, 1), R(2, 2), R(0, 1), R(0, 2), R(1, 2)};
  }
  const haptic::SurfacePoint told = haptic::surface_point(model, state.q, Vec3::Zero(), xi_, force_);
  const Vec3 rest = tissue_.point(xi_).at - told.modal - told.residual * force_;
  const double since = sample_time * static_cast<double>(stamp_ - told_at_);
  rest_ = told_at_ > 0 ? Vec3(rest_ - std::expm1(-since / rest_smoothing) * (rest - rest_)) : rest;
  told_at_ = stamp_;
  state.rest = rest_;
  return answer;
}

}  // namespace palpate::bench
