#include "physics_node/contact/needle_tool.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

void refuse_unpierced(const ToolSpec& tool, const Body& body) {
  if (const char* what = not_to_be_pierced(body))
    throw InputError(fmt::format(
        "{}: a rigid needle goes through finite elements of first order that do not break, and \"{}\" is {}",
        tool.place.text(), body.name, what));
  if (std::ranges::any_of(body.laws, [](const ElementLaw& law) { return law.cut_toughness <= 0; }))
    throw InputError(
        fmt::format("{}: shape = \"needle\" needs to know how tough \"{}\" is; give each of its materials "
                    "cut_toughness_J_per_m2, such as 164 of a liver",
                    tool.place.text(), body.name));
}

}  // namespace

NeedleTool::NeedleTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
                       const std::vector<TouchableBody>& touchable, double period)
    : PressingTool(index, tool.set_point),
      attitude_(tool.attitude),
      stiffness_(tool.stiffness),
      play_(period) {
  const NeedleSpec needle{
      .diameter = 2 * tool.radius, .length = tool.length, .friction = tool.shaft_friction};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    refuse_unpierced(tool, bodies[b]->body());
    bodies_.push_back(
        std::make_unique<OfBody>(OfBody{TipEntry(touchable[b]), NeedleChannel(*bodies[b], needle)}));
  }
}

void NeedleTool::let_go() noexcept {
  for (const auto& body : bodies_) body->channel.let_go();
  done_ = {};
  presses_ = false;
}

void NeedleTool::reset() noexcept {
  play_.reset();
  let_go();
  engaged_ = near_ = false;
  keep_ = 1;
}

void NeedleTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  elapsed_ = 0;
  const ToolState hand = state != nullptr ? numbered(*state) : ToolState{};
  if (!play_.take(state != nullptr ? &hand : nullptr, dt)) let_go();
  keep_ = spring_left(keep_, state != nullptr, dt);
  if (state == nullptr) return;
  note(*state);
  engaged_ = state->engaged != 0;
}

void NeedleTool::find_contact(double t) noexcept {
  near_ = false;
  if (!play_.seen()) return;
  if (!engaged_) let_go();
  hand_ = play_.at(0).x;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    OfBody& one = *bodies_[b];
    if (now().channel.holds() && b != touched_) continue;
    one.entry.look(one.channel.holds() ? one.channel.tip() : hand_, play_.way(), t);
    near_ = near_ || one.entry.is_near() || one.channel.holds();
  }
  if (!near_) let_go();
}

void NeedleTool::begin_step() noexcept {
  if (!may_press()) return;
  for (const auto& body : bodies_) {
    body->entry.begin_step();
    body->channel.begin_step();
  }
}

double NeedleTool::press(double dt) noexcept {
  elapsed_ += dt;
  done_ = {};
  presses_ = false;
  const double share = frame_dt_ > 0 ? elapsed_ / frame_dt_ : 1.0;
  hand_ = play_.at(share).x;
  along_ = -(play_.attitude(share).toRotationMatrix() * attitude_).col(2);
  if (!may_press() || keep_ == 0) return 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (now().channel.holds() && b != touched_) {
      bodies_[b]->channel.let_go();
      continue;
    }
    NeedleChannel& channel = bodies_[b]->channel;
    const NeedleOutcome done = channel.step(bodies_[b]->entry, hand_, along_, keep_ * stiffness_, dt);
    if (!channel.holds() && b != touched_) continue;
    touched_ = b;
    done_ = done;
    presses_ = true;
  }
  book().cut(done_.area, done_.work);
  book().pierced(now().channel.depth(), done_.rubbed, done_.entered ? done_.force.norm() : 0);
  return done_.power;
}

Wrench NeedleTool::wrench() const noexcept {
  return {-done_.force, -done_.moment + (now().channel.tip() - set_point_).cross(-done_.force)};
}

void NeedleTool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns,
                              double t) const noexcept {
  begin_wrench(out, wrench(), frame, now_ns, t);
  if (!presses_) return;
  // What slips gives no more force as the hand goes on. Yet of a way that no spring holds the hand feels none at all.
  constexpr double least = 0.01;
  const double k = keep_ * stiffness_;
  const auto in_series = [k](double held) { return k * held / (k + held); };
  const double across = std::max(in_series(done_.across), least * k),
               along = std::max(in_series(done_.along), least * k);
  Mat6 K = Mat6::Zero();
  K.topLeftCorner<3, 3>() =
      across * Eigen::Matrix3d::Identity() + (along - across) * along_ * along_.transpose();
  Eigen::Map<Mat6>(out.stiffness.data()) = K;  // symmetric
}

}  // namespace palpate::physics
