// S12: forces and torques of a tool that is more than a point, from answers that jump about a hand that moves and turns.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "bench/haptic/rows.h"
#include "bench/haptic/trial.h"
#include "common/message/vec3.h"

namespace palpate::bench {
namespace {

constexpr double least_torque_limit = 0.02, force_limit = 3.0;

struct SixTally {
  double torque_most = 0, force_most = 0, off_direction = 0, surplus = 0;
  double excess = -1;  // of the work of springs above its bound [J]
  bool bad_rejected = true, faulted = true;
};

/// One to three contacts, as springs and as a wrench.
ToolWrench random_answer(std::mt19937_64& random, std::uint64_t tick, const Vec3& x,
                         const Eigen::Quaterniond& q) {
  std::normal_distribution<double> g;
  Vec6 W = Vec6::Zero();
  Mat6 K = Mat6::Zero();
  const int n = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < n; ++i) {
    const Vec3 normal = Vec3(0.5 * g(random), 0.5 * g(random), 1).normalized();
    const Vec3 arm = 0.04 * Vec3(g(random), g(random), g(random));
    Vec6 contact;
    contact << normal, arm.cross(normal);
    W += std::abs(g(random)) * contact;
    K += 200 * contact * contact.transpose();
  }
  ToolWrench wrench;
  wrench.tick = tick;
  wrench.p_WT = wrench.tip = wrench.set_point = array(x);
  wrench.q_WT = {q.w(), q.x(), q.y(), q.z()};
  wrench.force = array(Vec3(W.head<3>()));
  wrench.moment = array(Vec3(W.tail<3>()));
  Eigen::Map<Mat6>(wrench.stiffness.data()) = K;
  return wrench;
}

/// The surface under a tool, up to 4 mm away or as deep, in place of what it presses with.
void tell_surface(std::mt19937_64& random, ToolWrench& wrench) {
  std::normal_distribution<double> g;
  const Vec3 n = Vec3(0.5 * g(random), 0.5 * g(random), 1).normalized();
  const Vec3 arm = 0.04 * Vec3(g(random), g(random), g(random)), spread = 0.3 * arm;
  Vec6 push, turn;
  push << n, arm.cross(n);
  turn << Vec3::Zero(), spread.cross(n);
  const double k = 100 + static_cast<double>(random() % 900);
  Eigen::Map<Mat6>(wrench.stiffness.data()) = k * (push * push.transpose() + turn * turn.transpose());
  wrench.normal = array(n);
  wrench.stretch = std::clamp(0.002 * g(random), -0.004, 0.004);
}

void move_for_ten_seconds(std::uint64_t seed, SixTally& tally) {
  std::mt19937_64 random(seed);
  haptic::ControllerSettings settings;
  settings.model = ForceModel::tangent;
  settings.force_limit = force_limit;
  settings.torque_limit = least_torque_limit;
  haptic::Controller controller(settings);
  controller.set_state(haptic::HapticState::ready);
  std::int64_t now = 1'000'000'000;
  haptic::DeviceSample sample;
  sample.has_new = sample.powered = true;
  ToolWrench wrench;
  ContactPatch patch;
  Vec6 acting[2] = {Vec6::Zero(), Vec6::Zero()};  // one tick from sample to force
  Vec3 last_x = Vec3::Zero();
  Eigen::Quaterniond last_q = Eigen::Quaterniond::Identity();
  EnergyBook energy;
  const double w_x = 6 + static_cast<double>(random() % 7), w_q = 5 + static_cast<double>(random() % 9);
  for (int n = 1; n <= 10'000; ++n) {
    const double t = 1e-3 * n, s = std::min(1.0, t);
    sample.t_ns = now;
    sample.x = s * Vec3(0.003 * std::sin(2 * t), 0.002 * std::cos(3 * t), 0.004 * std::sin(w_x * t));
    sample.q = Eigen::AngleAxisd(s * 0.08 * std::sin(w_q * t), Vec3(1, 2, -1).normalized());
    energy.given(acting[1].dot(haptic::motion_between(last_x, last_q, sample.x, sample.q)));
    last_x = sample.x;
    last_q = sample.q;
    patch.tick = static_cast<std::uint64_t>(n);
    // Free for the first half second, so that it arms; then an answer each 1 to 50 ms, here and there out of nothing.
    if (n <= 500 || random() % 25 == 0) {
      const bool touches = n > 500 && random() % 5 != 0;
      wrench = touches ? random_answer(random, patch.tick, sample.x, sample.q) : ToolWrench{};
      if (touches && seed % 2 == 0) tell_surface(random, wrench);
      wrench.tick = patch.tick;
    }
    const haptic::ControllerOutput out = controller.tick(now, sample, &patch, &wrench);
    tally.torque_most = std::max(tally.torque_most, out.torque.norm());
    tally.force_most = std::max(tally.force_most, out.force.norm());
    const Vec3 felt = controller.contact().torque;
    if (felt.norm() > least_torque_limit && out.torque.norm() > 0.999 * least_torque_limit)
      tally.off_direction =
          std::max(tally.off_direction,
                   std::acos(std::clamp(felt.normalized().dot(out.torque.normalized()), -1.0, 1.0)));
    acting[1] = acting[0];
    acting[0] << out.force, out.torque;
    energy.tick(1e-9 * Trial::tick_ns, controller.stored(), controller.plane_work(),
                controller.contact().n_planes > 0);
    now += Trial::tick_ns;
  }
  tally.surplus = std::max(tally.surplus, energy.surplus());
  tally.excess = std::max(tally.excess, energy.plane_excess());
  // Attitudes that are none: rejected, and after three a fault.
  sample.is_rotation = false;
  const std::uint64_t before = controller.motion().rejected();
  for (int n = 0; n < 3; ++n)
    sample.t_ns = now += Trial::tick_ns, controller.tick(now, sample, &patch, &wrench);
  tally.bad_rejected = tally.bad_rejected && controller.motion().rejected() == before + 3;
  tally.faulted = tally.faulted && controller.state() == haptic::HapticState::fault;
}

}  // namespace

Row torque_is_bounded(const Runs& runs) {
  SixTally tally;
  const int cases = runs.effort == Effort::full ? 200 : 20;
  for (int n = 1; n <= cases; ++n) move_for_ten_seconds(static_cast<std::uint64_t>(n), tally);
  return {
      "S12",
      "wrenches of 1 to 3 contacts or surfaces, which jump, under a hand that moves 4 mm and turns 5 deg; "
      "attitudes "
      "that are none",
      "torque reaches its limit; torque and force limited by norm, direction kept within 0.1 deg; G <= 0.1 "
      "mJ; bound on the work of "
      "springs kept; bad attitudes rejected, 3 a fault",
      fmt::format("{} hands of 10 s: torque {:.4f} of {} N m, force {:.2f} of {} N, direction {:.1e} "
                  "deg; G {:.3f} mJ, work {:+.3f} mJ of its bound; {}",
                  cases, tally.torque_most, least_torque_limit, tally.force_most, force_limit,
                  tally.off_direction * 180 / M_PI, 1e3 * tally.surplus, 1e3 * tally.excess,
                  tally.bad_rejected && tally.faulted ? "rejected, fault" : "let in"),
      tally.torque_most > 0.99 * least_torque_limit && tally.force_most > 0.5 &&
          tally.torque_most <= least_torque_limit * (1 + 1e-9) &&
          tally.force_most <= force_limit * (1 + 1e-9) && tally.off_direction <= 0.1 * M_PI / 180 &&
          tally.surplus <= EnergyBook::G_allowed && tally.excess <= 1e-9 && tally.bad_rejected &&
          tally.faulted};
}

}  // namespace palpate::bench
