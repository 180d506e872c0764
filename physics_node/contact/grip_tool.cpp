#include "physics_node/contact/grip_tool.h"

#include <algorithm>

#include "common/message/vec3.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {

GripTool::GripTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies, double period)
    : PressingTool(index, tool.set_point),
      radius_(tool.radius),
      grip_(tool.grip),
      stiffness_(tool.stiffness),
      play_(period) {
  std::size_t most = 0;
  for (const auto& body : bodies) {
    bodies_.push_back(body.get());
    most = std::max(most, body->body().nodes().size() + body->body().most_copies());
  }
  held_.reserve(std::min(most, most_held));
  forces_.reserve(held_.capacity());
}

void GripTool::open() noexcept {
  held_.clear();
  forces_.clear();
  force_.setZero();
}

void GripTool::reset() noexcept {
  play_.reset();
  open();
  wants_ = closed_ = false;
  keep_ = 1;
}

void GripTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  elapsed_ = 0;
  keep_ = spring_left(keep_, state != nullptr, dt);
  if (state == nullptr) {
    play_.take(nullptr, dt);
    return;
  }
  const ToolState hand = numbered(*state);
  // A hand that begins anew holds nothing, whatever its button says.
  if (!play_.take(&hand, dt)) open();
  note(*state);
  wants_ = state->engaged != 0 && (state->buttons & 1U) != 0;
}

void GripTool::find_contact(double) noexcept {
  if (!play_.seen()) return;
  hand_ = play_.at(0).x;
  if (!wants_) {
    open();
    closed_ = false;
  } else if (!closed_) {
    close();
    closed_ = true;
  }
}

/// Takes hold of what is between the jaws now.
void GripTool::close() noexcept {
  open();
  double most = 0;
  std::size_t best = bodies_.size();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    hold(*bodies_[b]);
    double mass = 0;
    for (const Held& one : held_) mass += one.share;
    if (mass > most) most = mass, best = b;
  }
  held_.clear();
  if (best == bodies_.size()) return;
  touched_ = best;
  const BodyModel& body = *bodies_[best];
  hold(body);
  for (Held& one : held_) one.share /= most;
  find_mobility();
  at_ = held_place();
  offset_ = offset_at_first_ = hand_ - at_;
}

/// Lists masses of a body that move, each with its mass by its weight [kg].
void GripTool::hold(const BodyModel& body) noexcept {
  held_.clear();
  body.body().each_node([&](Index node) {
    const double inverse = body.body().inverse_mass[static_cast<std::size_t>(node)];
    const double near = 1 - (body.position(node) - hand_).squaredNorm() / (radius_ * radius_);
    if (inverse == 0 || !(near > 0) || held_.size() == held_.capacity()) return;
    held_.push_back({node, near * near / inverse});
  });
}

/// A cut has gone through what is held: both sides of a node stay between the jaws, each with its own mass.
void GripTool::follow_cuts() noexcept {
  if (held_.empty()) return;
  const BodyModel& body = *bodies_[touched_];
  bool any = false;
  for (const NodeSplit& split : body.events().nodes_split) {
    const auto held = std::ranges::find(held_, split.node, &Held::node);
    const double inverse = body.body().inverse_mass[static_cast<std::size_t>(split.copy)],
                 other = body.body().inverse_mass[static_cast<std::size_t>(split.node)];
    if (held == held_.end() || inverse == 0 || other == 0 || held_.size() == held_.capacity()) continue;
    const double of_copy = other / (inverse + other) * held->share;
    held->share -= of_copy;
    held_.push_back({split.copy, of_copy});
    any = true;
  }
  if (any) find_mobility();
}

void GripTool::find_mobility() noexcept {
  mobility_ = 0;
  for (const Held& one : held_)
    mobility_ +=
        one.share * one.share * bodies_[touched_]->body().inverse_mass[static_cast<std::size_t>(one.node)];
}

Vec3 GripTool::held_place() const noexcept {
  Vec3 x = Vec3::Zero();
  for (const Held& one : held_) x += one.share * bodies_[touched_]->position(one.node);
  return x;
}

void GripTool::begin_step() noexcept {
  follow_cuts();
  v_before_.setZero();
  for (const Held& one : held_) v_before_ += one.share * bodies_[touched_]->velocity(one.node);
}

double GripTool::press(double dt) noexcept {
  elapsed_ += dt;
  forces_.clear();
  force_.setZero();
  hand_ = play_.at(frame_dt_ > 0 ? elapsed_ / frame_dt_ : 1.0).x;
  if (held_.empty() || keep_ == 0) return 0;
  at_ = held_place();
  const double K = keep_ * stiffness_, give = 1 + K * dt * dt * mobility_;
  force_ = K / give * (hand_ - offset_ - at_);
  if (const double asked = force_.norm(); asked > grip_) {
    offset_ += (1 - grip_ / asked) * give / K * force_;
    force_ *= grip_ / asked;
    if ((offset_ - offset_at_first_).norm() > radius_) {
      open();
      return 0;
    }
  }
  for (const Held& one : held_) forces_.push_back({one.node, one.share * force_});
  return force_.dot(v_before_);
}

Wrench GripTool::wrench() const noexcept { return {-force_, (at_ - set_point_).cross(-force_)}; }

void GripTool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns,
                            double t) const noexcept {
  begin_wrench(out, wrench(), frame, now_ns, t);
  if (forces_.empty()) return;
  // Also while it slips: of a way that no spring holds the hand feels no force.
  Mat6 K = Mat6::Zero();
  K.topLeftCorner<3, 3>() = keep_ * stiffness_ * Eigen::Matrix3d::Identity();
  Eigen::Map<Mat6>(out.stiffness.data()) = K;  // symmetric
}

}  // namespace palpate::physics
