// A hand presses tissue that gives, through slow and delayed patches. Everything in simulated time, the production
// controller and the production driver; only the wire and the tissue are small models here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <vector>

#include "common/scene/device_spec.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

/// One mass on a spring and a damper; its surface is at z = 0 without force. It feels the hand's force as reported,
/// low-passed at 5 Hz, and tells the plane that it would have without that force.
class YieldingTissue {
 public:
  void step(double reported_force, double dt) {
    const int substeps = static_cast<int>(std::lround(dt / 2e-5));
    const double h = dt / substeps;
    for (int i = 0; i < substeps; ++i) {
      load_ += (reported_force - load_) * h / (h + 1.0 / (2 * std::numbers::pi * 5.0));
      v_ += h / m * (-k * z_ - b * v_ - load_);
      z_ += h * v_;
    }
  }
  double rest_plane() const { return z_ + load_ / k; }
  double surface() const { return z_; }
  static constexpr double m = 0.1, b = 2, k = 200;

 private:
  double z_ = 0, v_ = 0, load_ = 0;
};

struct Case {
  double rate_Hz;
  double delay;
  double stiffness;
};

struct Outcome {
  double swing = 0;       // peak to peak of the tip in the last second [m]
  double force = 0;       // mean in the last second [N]
  double plane_work = 0;  // largest rise of the work of planes above its least so far, less the trickle [J]
  double energy_max = 0;  // given to the hand [J]
  double force_step = 0;  // largest change in a tick [N]
  double surplus = 0;     // max of E_port + S - E_plane [J]
};

/// A delayed link is a queue of (arrival, value).
template <class T>
class Link {
 public:
  void send(std::int64_t arrives, const T& value) { queue_.emplace_back(arrives, value); }
  bool receive(std::int64_t now, T& value) {
    bool any = false;
    while (!queue_.empty() && queue_.front().first <= now) {
      value = queue_.front().second;
      queue_.pop_front();
      any = true;
    }
    return any;
  }

 private:
  std::deque<std::pair<std::int64_t, T>> queue_;
};

Outcome press_yielding_tissue(HandModel hand, const Case& c, double depth) {
  // It touches after the ramp of arming: until then springs hold less than their stretch says.
  VirtualWorld world(
      scene_with(hand, {{0, {0, 0, 0.02}}, {0.6, {0, 0, 0.02}}, {0.9, {0, 0, -depth}}}, c.stiffness));
  YieldingTissue tissue;
  Link<double> to_tissue;
  Link<ContactPatch> to_hand;
  double force_at_tissue = 0;
  ContactPatch patch;
  std::uint64_t sent = 0;
  const auto delay = static_cast<std::int64_t>(c.delay * 1e9);
  const auto every = static_cast<std::int64_t>(1e9 / c.rate_Hz);
  std::int64_t next = world.now;
  Outcome outcome;
  double low = 1, high = -1, least_work = 0, sum = 0, last_force = 0;
  int n = 0;
  const int ticks = 6000;
  for (int tick = 0; tick < ticks; ++tick) {
    const std::int64_t now = world.now;
    to_tissue.send(now + delay, world.session.tool_state().force_on_hand[2]);
    if (now >= next) {
      next += every;
      to_tissue.receive(now, force_at_tissue);
      ContactPatch newest = flat_patch(++sent, 0, YieldingTissue::k);
      const double plane = tissue.rest_plane();
      for (auto& facet : newest.facets) {
        facet.point[2] = plane;
        for (auto& corner : facet.corners) corner[2] = tissue.surface();
      }
      to_hand.send(now + delay, newest);
    }
    if (to_hand.receive(now, patch)) world.patch = patch, world.has_patch = true;
    world.run(1e-3, 0);
    tissue.step(force_at_tissue, 1e-3);

    const Controller& controller = world.session.controller();
    const double work = controller.plane_work();
    least_work = std::min(least_work, work - WorkTank::trickle * 1e-3 * tick);
    outcome.plane_work = std::max(outcome.plane_work, work - WorkTank::trickle * 1e-3 * tick - least_work);
    outcome.energy_max = world.session.counts().energy_max;
    outcome.surplus =
        std::max(outcome.surplus, world.session.counts().energy + controller.contact().stored - work);
    outcome.force_step = std::max(outcome.force_step, std::abs(world.fz() - last_force));
    last_force = world.fz();
    if (tick < ticks - 1000) continue;
    low = std::min(low, world.z());
    high = std::max(high, world.z());
    sum += world.fz();
    ++n;
  }
  outcome.swing = high - low;
  outcome.force = sum / n;
  return outcome;
}

const std::pair<HandModel, double> hands[] = {
    {HandModel::arm, 135}, {HandModel::pinch, 100}, {HandModel::firm, 700}};

double series(double a, double b, double c) { return 1.0 / (1.0 / a + 1.0 / b + 1.0 / c); }

TEST(NortonContact, IsStableAndTrueForEveryHandRateAndDelay) {
  for (const double k : {300.0, 400.0, 500.0}) {
    for (const auto& [hand, k_hand] : hands) {
      for (const double rate : {20.0, 60.0, 150.0, 1000.0}) {
        for (const double delay : {0.0, 5e-3, 20e-3}) {
          const double k_all = series(k, YieldingTissue::k, k_hand);
          const Outcome outcome = press_yielding_tissue(hand, {rate, delay, k}, 1.0 / k_all);
          const auto where = ::testing::Message() << "K " << k << ", hand " << k_hand << " N/m, " << rate
                                                  << " Hz, " << 1e3 * delay << " ms";
          EXPECT_LT(outcome.swing, 100e-6) << where;
          EXPECT_NEAR(outcome.force, 1.0, 0.02) << where;
        }
      }
    }
  }
}

TEST(NortonContact, KeepsItsBoundsOfEnergyAndForceSteps) {
  for (const auto& [hand, k_hand] : hands) {
    for (const double rate : {20.0, 150.0, 1000.0}) {
      for (const double delay : {0.0, 20e-3}) {
        const double k_all = series(400, YieldingTissue::k, k_hand);
        const Outcome outcome = press_yielding_tissue(hand, {rate, delay, 400}, 1.0 / k_all);
        const auto where = ::testing::Message()
                           << "hand " << k_hand << " N/m, " << rate << " Hz, " << 1e3 * delay << " ms";
        EXPECT_LE(outcome.plane_work, WorkTank::capacity * (1 + 1e-9) + 1e-12) << where;
        // The spring held over a tick leaks K v^2 T^2 / 2 at each impact; the approach is at most 0.1 m/s here.
        EXPECT_LE(outcome.surplus, 1e-4 + 10 * 400 * 0.1 * 0.1 * 1e-6 / 2) << where;
        EXPECT_LE(outcome.force_step, 0.3) << where;
      }
    }
  }
}

/// Force computed by slow physics and held until the next answer: no local model at all.
double swing_of_held_force(double stiffness, double rate_Hz, double delay) {
  const double dt = 2e-5, m = 0.045 + 0.02, b = 1.0, k_hand = 100.0;  // a pinch
  double x = 0.02, v = 0, force = 0, low = 1, high = -1;
  Link<double> up, down;
  double x_seen = x;
  const int steps = static_cast<int>(6.0 / dt);
  const int every = static_cast<int>(1.0 / rate_Hz / dt);
  const auto late = static_cast<std::int64_t>(delay / dt);
  const double goal = -1.0 / series(stiffness, 1e9, k_hand);
  for (int i = 0; i < steps; ++i) {
    const double q = 0.02 + (goal - 0.02) * std::min(1.0, i * dt / 0.3);
    up.send(i + late, x);
    if (i % every == 0) {
      up.receive(i, x_seen);
      down.send(i + late, std::clamp(-stiffness * x_seen, 0.0, 3.3));
    }
    down.receive(i, force);
    v += dt / m * (k_hand * (q - x) - b * v + force);
    x += dt * v;
    if (i * dt > 5) low = std::min(low, x), high = std::max(high, x);
  }
  return high - low;
}

TEST(NegativeControl, HeldForcesOfSlowPhysicsAreSeenToBeUnstable) {
  EXPECT_GT(swing_of_held_force(1000, 20, 20e-3), 1e-3);
  EXPECT_LT(swing_of_held_force(50, 1000, 0), 1e-4);  // and what is stable is seen to be
}

}  // namespace
}  // namespace palpate::haptic::test
