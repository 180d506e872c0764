#include "haptic_node/tissue/tissue_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/haptic_node/tissue/some_tissues.h"

namespace palpate::haptic {
namespace {

using std::numbers::pi;

constexpr double h = 1e-3;

TEST(TissueStep, PressesAWallWithSpringAndDamper) {
  const ContactSpring spring{500, 1};
  const TissueStep step({}, spring, h);
  TissueState state;
  state.rest = down(1e-3);
  step.advance(state, tip_down(0.9e-3, 0.1));
  EXPECT_EQ(pressed(state), 0);
  step.advance(state, tip_down(3e-3, 0.1));
  EXPECT_NEAR(pressed(state), 500 * 2e-3 + 0.1, 1e-12);
  step.advance(state, tip_down(3e-3, 10));  // the damper adds half of the spring at most
  EXPECT_NEAR(pressed(state), 1.5, 1e-12);
  step.advance(state, tip_down(3e-3, -10));  // and never pulls
  EXPECT_EQ(pressed(state), 0);
}

double root(auto&& surplus) {
  double low = 0, high = 10;
  for (int i = 0; i < 100; ++i) (surplus(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return low;
}

/// What it and its branches bear, in small steps, at the end of a tick in which F_e goes straight to a value.
double borne_at(const TissueModel& model, const TissueState& before, double stays_end) {
  const double stays = staying(model, before, pressed(before));
  constexpr int steps = 1000;
  double force = stays_end;
  for (std::uint32_t j = 0; j < model.n_branches; ++j) {
    const auto& [k, tau, g] = model.branches[j];
    double f = before.f[j];
    for (int i = 0; i < steps; ++i) {  // by the middle
      const double mean = stays + (i + 0.5) / steps * (stays_end - stays), u = h / steps / tau;
      f += u / (1 + 0.5 * u) * (mean - f);
    }
    force += g * (stays_end - f);
  }
  return force;
}

/// F of the law at the end of a tick, by halving: K (e - z) + B (e' - z'), not below 0 nor above 3/2 of what the spring alone gives.
double by_law(const TissueModel& model, const ContactSpring& spring, double e, double e_dot,
              const TissueState& before) {
  // That is straight in its end.
  const double none = borne_at(model, before, 0), by_one = borne_at(model, before, 1) - none;
  const auto z = [&](double F) { return model.contact().give((F - none) / by_one); };
  if (e <= z(0)) return 0;
  const double z_before = model.contact().give(staying(model, before, pressed(before)));
  const double whole = root([&](double F) {
    return spring.stiffness * (e - z(F)) + spring.damping * (e_dot - (z(F) - z_before) / h) - F;
  });
  const double alone = root([&](double F) { return spring.stiffness * (e - z(F)) - F; });
  return std::min(whole, 1.5 * alone);
}

/// At the end of a tick the force that was solved for is the one that the law of the spring gives there.
TEST(TissueStep, SolvesTheLawOfTheSpringAtItsEnd) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> depth(-2e-3, 6e-3), speed(-0.5, 0.5);
  for (const TissueModel& model : some_tissues()) {
    const TissueStep step(model, {500, 1}, h);
    TissueState state;
    int in_contact = 0;
    for (int i = 0; i < 2000; ++i) {
      const TissueState before = state;
      const double x = depth(random), v = speed(random);
      step.advance(state, tip_down(x, v));
      const double e = x + modal_surface(model, state).z(), e_dot = v + modal_speed(model, state).z();
      const double precision = model.stiffening() > 1 ? 1e-6 : 1e-9;  // of the small steps
      EXPECT_NEAR(pressed(state), by_law(model, step.spring(), e, e_dot, before), precision);
      if (model.growth == 0 && model.stiffening() == 1) {
        EXPECT_NEAR(pressed(state), step.spring().force(model.residual, h, e, e_dot, pressed(before)), 1e-9);
      }
      in_contact += pressed(state) > 0;
    }
    EXPECT_GT(in_contact, 500);
  }
}

/// Against the same tissue in steps that are a hundred times as short.
TEST(TissueStep, IsNearlyThatOfTinySubsteps) {
  for (const TissueModel& model : some_tissues()) {
    const TissueStep step(model, {500, 1}, h), fine(model, {500, 1}, h / 100);
    TissueState state, truth;
    double most = 0, error = 0;
    const auto depth = [](double t) { return 2e-3 * (1 - std::cos(2 * pi * 8 * t)); };
    const auto speed = [](double t) { return 2e-3 * 2 * pi * 8 * std::sin(2 * pi * 8 * t); };
    for (int n = 1; n <= 500; ++n) {
      step.advance(state, tip_down(depth(n * h), speed(n * h)));
      for (int i = 1; i <= 100; ++i) {
        const double t = (n - 1 + i / 100.0) * h;
        fine.advance(truth, tip_down(depth(t), speed(t)));
      }
      most = std::max(most, truth.force.norm());
      error = std::max(error, (truth.force - state.force).norm());
    }
    EXPECT_LT(error, 0.02 * most) << model.n_modes << " modes, " << model.residual;
  }
}

/// Without modes, pressed by a force that grows straight, it gives as z of the integral of creep: F_e of beta F_e' + F_e = F, and of a standard
/// linear solid.
TEST(TissueStep, CreepsAsTheClosedFormDoes) {
  constexpr double rate = 2, beta = 5e-3, tau = 0.1, g = 1.5;  // [N/s]
  for (const bool viscous : {true, false}) {
    TissueModel model;
    model.residual = 7e-3, model.growth = 15;
    model.n_branches = 1;
    model.branches[0] = viscous ? RelaxingBranch{0, 0.1e-3, beta / 0.1e-3} : RelaxingBranch{0, tau, g};
    const auto stays = [&](double t) {
      if (viscous) return rate * (t + beta * std::expm1(-t / beta));
      const double late = (1 + g) * tau;  // F_e + (1 + g) tau F_e' = F + tau F'
      return rate * (t + (late - tau) * std::expm1(-t / late));
    };
    const ContactSpring spring{500, 0};
    const TissueStep step(model, spring, h);
    TissueState state;
    for (int n = 1; n <= 400; ++n) {
      const double t = n * h, F = rate * t;
      step.advance(state, tip_down(F / spring.stiffness + model.contact().give(stays(t)), 0));
      if (n > 20) {
        EXPECT_NEAR(pressed(state), F, 0.01 * F) << viscous << " at " << t;
      }
    }
  }
}

/// Held for long the force is that of springs in series; branches have relaxed.
TEST(TissueStep, EndsAtTheStaticForce) {
  for (const TissueModel& model : some_tissues()) {
    const TissueStep step(model, {500, 1}, h);
    TissueState state;
    for (int n = 0; n < 60'000; ++n) step.advance(state, tip_down(3e-3, 0));
    double compliance = 1 / 500.0;
    for (std::uint32_t i = 0; i < model.n_modes; ++i)
      compliance += model.modes[i].psi.squaredNorm() / model.modes[i].stiffness;
    EXPECT_NEAR(compliance * pressed(state) + model.contact().give(pressed(state)), 3e-3, 1e-8);
  }
}

/// In a closed cycle of the hand tissue keeps nothing: what went in is what it dissipated, and it is not less than nothing.
TEST(TissueStep, DissipatesInAClosedCycle) {
  for (const TissueModel& model : some_tissues())
    for (const double frequency : {0.5, 3.0, 11.0, 30.0}) {
      const TissueStep step(model, {500, 1}, h);
      TissueState state;
      const auto depth = [&](double t) { return 2e-3 - 0.5e-3 * std::cos(2 * pi * frequency * t); };
      const int cycle = static_cast<int>(std::lround(1 / (frequency * h)));
      double given = 0, dissipated = 0, before = 0;
      for (int n = 1; n <= 60 * cycle; ++n) {
        const double then = (n - 1.0) / (cycle * frequency), now = n / (cycle * frequency);
        const StepWork work =
            step.advance(state, down(depth(then)), tip_down(depth(now), (depth(now) - depth(then)) / h));
        if (n > 59 * cycle) given += work.given, dissipated += work.dissipated;
        if (n == 59 * cycle) before = step.held(state, down(depth(now))).energy;
      }
      const double after = step.held(state, down(depth(0))).energy;
      EXPECT_NEAR(given - dissipated, after - before, 1e-15);
      EXPECT_GT(dissipated, 0) << model.n_modes << " modes at " << frequency << " Hz";
    }
}

/// Without a hand energy only falls, and without dampers it stays.
TEST(TissueStep, KeepsTheEnergyOfAFreeSwing) {
  TissueModel model;
  model.n_modes = 2;
  model.modes[0] = {down(3), 4000, 0};
  model.modes[1] = {Vec3(1, 2, 0), 90'000, 0};
  const TissueStep step(model, {500, 1}, h);
  TissueState state;
  state.q = {1e-3, -2e-3};
  state.w = {0.1, 0.2};
  const double before = tissue_energy(model, state);
  for (int n = 0; n < 10'000; ++n) step.advance(state, tip_down(-1, 0));
  EXPECT_NEAR(tissue_energy(model, state), before, 1e-9 * before);
}

/// C F = e along all three directions; held for long beside where it first touched, it sticks or lies on the cone of friction.
TEST(TissueStep, SticksAndSlidesAtRest) {
  for (const double friction : {0.0, 0.3, 2.0}) {
    const TissueModel model = leaning(friction);
    const TissueStep step(model, {500, 1}, h);
    TissueState state;
    const Vec3 in = -2e-3 * model.normal, side = Vec3(0, 3e-3, 0);
    for (int n = 0; n < 6000; ++n)
      step.advance(state, {in + std::clamp((n - 1000) / 4000.0, 0.0, 1.0) * side, Vec3::Zero()});
    const double normal = -model.normal.dot(state.force);
    const Vec3 across = state.force + normal * model.normal;
    EXPECT_GT(normal, 0.3);
    EXPECT_LE(across.norm(), friction * normal + 1e-9);
    if (friction < 1) {
      EXPECT_NEAR(across.norm(), friction * normal, 1e-6) << "it has slid";
    } else {
      EXPECT_GT(across.y(), 0.1) << "what sticks is carried along";
    }
    Mat3 C = Mat3::Identity() / 500 + model.compliance();
    for (std::uint32_t i = 0; i < model.n_modes; ++i)
      C += model.modes[i].psi * model.modes[i].psi.transpose() / model.modes[i].stiffness;
    const Vec3 gap = in + side - C * state.force - state.rest;
    EXPECT_NEAR(gap.norm(), 0, 1e-7) << friction;
  }
}

/// Along a straight way energy that a slide takes is what friction does: nothing is made, in a closed way something is lost.
TEST(TissueStep, LosesEnergyInAClosedWayWithFriction) {
  for (const double friction : {0.0, 0.1, 0.5}) {
    const TissueStep step(leaning(friction), {500, 1}, h);
    TissueState state;
    const Vec3& n = step.model().normal;
    const auto at = [&](double t) {
      return Vec3(-2e-3 * n + 3e-3 * Vec3(0, std::cos(2 * pi * 2 * t), 0) +
                  3e-3 * std::sin(2 * pi * 2 * t) * n.cross(Vec3::UnitY()));
    };
    double dissipated = 0, least = 0;
    for (int i = 1; i <= 5000; ++i) {
      const Vec3 before = at((i - 1) * h), now = at(i * h);
      const StepWork work = step.advance(state, before, {now, (now - before) / h});
      if (i > 4000) dissipated += work.dissipated, least = std::min(least, work.dissipated);
    }
    EXPECT_GT(dissipated, friction > 0 ? 1e-4 : -1e-9) << friction;
    EXPECT_GT(least, -1e-6);
  }
}

TEST(TissueModel, RejectsWhatIsNoTissue) {
  TissueAnswer good;
  good.model = some_tissues().back();
  good.state.force = down(0.5);
  EXPECT_TRUE(is_sound(good, 0));
  EXPECT_FALSE(is_sound(good, 1));
  const auto rejected = [&](auto&& spoil) {
    TissueAnswer bad = good;
    spoil(bad);
    return !is_sound(bad, 0);
  };
  const double nan = std::nan("");
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.n_modes = 10; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.n_branches = 6; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.branches[1].share = -1; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.state.f[0] = nan; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.state.f[1] = -1e-3; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.model.modes[0].psi.y() = nan; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.modes[0].stiffness = -1; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.model.modes[0].damping = nan; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.state.q[0] = nan; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.state.w[0] = INFINITY; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.branches[0].time = 0; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.state.p[0] = nan; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.residual = -1e-6; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.residual_across = 2; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.growth = -1; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.model.growth = nan; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.model.normal = Vec3(0, 0, 1.1); }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.model.friction = nan; }));
  EXPECT_TRUE(rejected([&](TissueAnswer& a) { a.state.rest.x() = nan; }));
  EXPECT_TRUE(rejected([](TissueAnswer& a) { a.state.force.z() = 0.1; }));
}

}  // namespace
}  // namespace palpate::haptic
