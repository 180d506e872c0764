#include "bench/haptic/trial.h"

#include <algorithm>
#include <cmath>

#include "common/message/vec3.h"
#include "common/scene/force_model.h"
#include "haptic_node/control/tell_motion.h"

namespace palpate::bench {
namespace {

/// What a scene would name for a hand that feels in this way.
std::optional<ForceModel> asked_by(const Case& c) {
  if (c.mode == RenderMode::raw_planes) return ForceModel::raw_planes;
  if (c.mode == RenderMode::direct) return ForceModel::direct;
  return c.feels;
}

haptic::ControllerSettings settings_of(const Case& c) {
  haptic::ControllerSettings settings;
  settings.stiffness = c.stiffness;
  settings.damping = c.damping;
  settings.force_limit = c.device.force_limit;
  settings.resolution = c.device.resolution;
  settings.torque_limit = c.torque_limit;
  settings.friction = c.friction;
  if (c.slab != nullptr) {
    ToolSpec tool;
    tool.shape = c.slab->stick ? ToolShape::stick : ToolShape::point;
    tool.force_model = asked_by(c);
    settings.model = felt_force_model(tool, c.torque_limit).model;
  }
  return settings;
}

haptic::TouchSettings touch_settings_of(const Case& c, double period) {
  haptic::TouchSettings settings;
  settings.spring = {c.stiffness, c.damping};
  settings.period = period;
  settings.force_limit = c.device.force_limit;
  settings.resolution = c.device.resolution;
  return settings;
}

PlaneKind kind_of(RenderMode mode) { return mode == RenderMode::local ? PlaneKind::norton : PlaneKind::raw; }

}  // namespace

Trial::Trial(const Case& c, Path path)
    : case_(c),
      path_(std::move(path)),
      plant_(c.device, c.hand, path_(0).q),
      tissue_(c.object, kind_of(c.mode)),
      settings_(settings_of(c)),
      controller_(settings_),
      motion_(settings_.period),
      touch_(touch_settings_of(c, settings_.period)),
      up_(c.link, 2 * c.seed),
      down_(c.link, 2 * c.seed + 1),
      now_ns_(start_ns - static_cast<std::int64_t>(lead_in * 1e9)),
      next_frame_ns_(now_ns_) {
  controller_.set_state(haptic::HapticState::ready);
  if (c.slab != nullptr)
    world_ = std::make_unique<WorldObject>(
        slab_scene(*c.slab, asked_by(c), c.rate_Hz, c.stiffness, c.damping, c.friction));
  if (is_pressed_by_motion(c.mode))
    pressed_ = std::make_unique<PressedTissue>(c.specimen != nullptr ? *c.specimen : specimen_of(c.object),
                                               c.told, haptic::ContactSpring{c.stiffness, c.damping});
}

Trial::HandReport Trial::report() {
  HandReport hand{rendered_.reported.z(), plant_.measured(), rendered_.proxy, {}, {}};
  if (pressed_) hand.samples = newest_samples(touch_.history(), straight);
  if (!world_) return hand;
  hand.state.tick = ++tick_;
  hand.state.stamp_ns = now_ns_;
  hand.state.p_WT = array(hand.x);
  hand.state.v_WT = array(controller_.motion().v());
  hand.state.proxy = array(hand.proxy);
  hand.state.force_on_hand = array(rendered_.reported);
  hand.state.force_now = array(rendered_.force);
  haptic::tell_motion(controller_, hand.state);
  hand.state.engaged = case_.mode != RenderMode::local || controller_.engaged() ? 1U : 0U;
  return hand;
}

/// A frame of the real physics, with the newest that it knows of the hand.
void Trial::answer_of_world() {
  HandReport came;
  if (up_.receive(now_ns_, came) && hands_.take(came.state, now_ns_)) known_ = came;
  Answer answer;
  const auto& fresh = hands_.at(now_ns_).front();
  world_->frame(fresh ? &*fresh : nullptr, tissue_.base(), physics_clock_ns(), answer.patch, answer.wrench);
  answer.patch.tick = answer.wrench.tick = ++frame_;
  if (!physics_alive) return;
  if (alter_patch) alter_patch(answer.patch, known_.proxy);
  down_.send(now_ns_, answer);
}

/// A frame of tissue that the hand's recorded motion presses.
void Trial::answer_of_pressed() {
  up_.receive(now_ns_, known_);
  const auto each = [this](double sample) {
    const double then = (sample - 1) * settings_.period - lead_in;
    if (move_object) move_object(tissue_, then);
    if (move_object) pressed_->specimen().set_base(-tissue_.base());
    if (alter_specimen) alter_specimen(pressed_->specimen(), then);
  };
  pressed_->frame(known_.samples.get(), 1.0 / case_.rate_Hz, each);
  if (!physics_alive || pressed_->stamp() == 0) return;
  Answer answer;
  answer.tissue = pressed_->answer(++frame_);
  answer.patch.tick = frame_;
  down_.send(now_ns_, answer);
}

/// Both directions of the link; physics frames.
void Trial::exchange() {
  up_.send(now_ns_, report());
  const bool due = now_ns_ >= next_frame_ns_;
  if (due) next_frame_ns_ += static_cast<std::int64_t>(1e9 / case_.rate_Hz);
  if (due && world_) {
    answer_of_world();
  } else if (due && pressed_) {
    answer_of_pressed();
  } else if (due) {
    up_.receive(now_ns_, known_);
    // Without a local model physics computes the force itself, from the last position that it knows.
    if (case_.mode == RenderMode::direct)
      known_.force =
          std::clamp(case_.stiffness * (tissue_.surface() - known_.x.z()), 0.0, settings_.force_limit);
    tissue_.take(known_.force);
    if (physics_alive) {
      Answer answer{tissue_.patch(++frame_), known_.force, {}};
      answer.patch.stamp_ns = physics_clock_ns();
      if (alter_patch) alter_patch(answer.patch, known_.proxy);
      down_.send(now_ns_, answer);
    }
  }
  Answer arrived;
  if (down_.receive(now_ns_, arrived)) newest_ = arrived;
}

void Trial::render() {
  haptic::DeviceSample sample;
  sample.has_new = true;
  sample.t_ns = now_ns_;
  sample.x = plant_.measured();
  sample.powered = powered_;
  if (spoil_sample) spoil_sample(sample);
  if (case_.mode == RenderMode::local) {
    rendered_ = local_force(controller_, now_ns_, sample, newest_ ? &newest_->patch : nullptr,
                            newest_ && world_ ? &newest_->wrench : nullptr);
    powered_ = powered_ || rendered_.want_power;
    return;
  }
  motion_.take(sample, now_ns_);
  if (pressed_) return render_pressed();
  rendered_ = {};
  if (!newest_) return;
  if (case_.mode == RenderMode::raw_planes)
    rendered_ = raw_plane_force(newest_->patch, motion_.x(), motion_.v(), settings_);
  else
    rendered_.force = {0, 0, newest_->force};
}

/// Tissue in one dimension, along z: what is aside of it slides.
void Trial::render_pressed() {
  const haptic::TissueAnswer* newest = newest_ ? &newest_->tissue : nullptr;
  const bool copies = case_.mode == RenderMode::copy;
  if (answers_.accept(newest, now_ns_) && copies) touch_.take(*newest);
  const Vec3 x(0, 0, motion_.x().z());
  double force = touch_.tick(x, copies ? answers_.gain(now_ns_) : 0.0).z();
  if (!copies && newest != nullptr && touch_.history().has(newest->stamp)) {
    double give = 1 / case_.stiffness + newest->model.residual;
    for (std::uint32_t i = 0; i < newest->model.n_modes; ++i)
      give += newest->model.modes[i].psi.squaredNorm() / newest->model.modes[i].stiffness;
    const double moved = (touch_.history().at(newest->stamp).x - x).z();
    force = std::clamp(-newest->state.force.z() + moved / give, 0.0, settings_.force_limit);
  }
  rendered_ = {};
  rendered_.force = rendered_.reported = {0, 0, force};
  rendered_.proxy = motion_.x();
  rendered_.touching = force > 0;
  rendered_.stored = copies ? touch_.stored() : 0.0;
  rendered_.plane_work = touch_.correction_work();
}

void Trial::book_force_step(const Vec3& force) {
  const double by = (force - in_flight_[0]).norm();
  force_step_ = std::max(force_step_, by);
  step_beyond_ = std::max(
      step_beyond_, by - case_.stiffness * (plant_.v().norm() * settings_.period + case_.device.resolution));
}

/// The force of `io_latency` ticks ago acts during this tick.
void Trial::advance_plant() {
  const Vec3 before = plant_.x();
  const Vec3 acting = in_flight_[static_cast<std::size_t>(case_.io_latency)];
  const double begin = t();
  const int steps = static_cast<int>(std::lround(settings_.period / Plant::step));
  for (int i = 0; i < steps; ++i) {
    const double now = begin + i * Plant::step;
    const Aim aim = path_(std::max(now, 0.0));
    if (kinematic)
      plant_.put(aim.q, now < 0 ? Vec3(Vec3::Zero()) : aim.q_dot);
    else
      plant_.advance(aim.q, now < 0 ? Vec3(Vec3::Zero()) : aim.q_dot, acting + push);
    if (move_object) move_object(tissue_, now);
    tissue_.advance(Plant::step);
  }
  energy_.moved(acting, plant_.x() - before);
}

void Trial::run(double until, const std::function<void()>& each) {
  while (t() < until - 1e-9) {
    exchange();
    render();
    book_force_step(rendered_.force);
    in_flight_[2] = in_flight_[1];
    in_flight_[1] = in_flight_[0];
    in_flight_[0] = rendered_.force;
    // The springs are known at the measured position; the port is booked at the true one.
    const double stored = rendered_.stored - rendered_.force.dot(plant_.x() - plant_.measured());
    energy_.tick(settings_.period, stored, rendered_.plane_work, rendered_.touching);
    advance_plant();
    now_ns_ += tick_ns;
    if (each) each();
  }
}

Path press_path(const Case& c, double force, double hold_until) {
  const double object = c.object.mass > 0 ? c.object.stiffness : rigid_stiffness;
  const double hand = c.hand.stiffness > 0 ? c.hand.stiffness : rigid_stiffness;
  const double depth = force * (1 / c.stiffness + 1 / object + 1 / hand);
  return [depth, hold_until](double t) {
    constexpr double above = 0.02, down = 0.3, slide = 1.0, aside = 0.02;
    const double retract = hold_until + slide;
    Aim aim;
    aim.q.z() = -depth;
    if (t < down) {
      aim.q.z() = above - (above + depth) * t / down;
      aim.q_dot.z() = -(above + depth) / down;
    } else if (t >= hold_until && t < retract) {
      aim.q.x() = aside * (t - hold_until) / slide;
      aim.q_dot.x() = aside / slide;
    } else if (t >= retract) {
      aim.q.x() = aside;
      const double s = std::min((t - retract) / down, 1.0);
      aim.q.z() = -depth + (above + depth) * s;
      if (s < 1) aim.q_dot.z() = (above + depth) / down;
    }
    return aim;
  };
}

}  // namespace palpate::bench
