#include "haptic_node/tissue/mode_response.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::haptic {
namespace {

constexpr double h = 1e-3;

/// The same by a million small steps (Runge and Kutta's fourth order is exact enough at h / 2000).
struct Mode {
  double stiffness, damping;
};
struct Swing {
  double q, w;
};
Swing by_small_steps(const Mode& mode, Swing s, double load, double load_end, int steps) {
  const double dt = h / steps;
  const auto slope = [&](double t, const Swing& at) {
    const double g = load + (load_end - load) * t / h;
    return Swing{at.w, g - mode.damping * at.w - mode.stiffness * at.q};
  };
  for (int i = 0; i < steps; ++i) {
    const double t = i * dt;
    const Swing a = slope(t, s), b = slope(t + dt / 2, {s.q + dt / 2 * a.q, s.w + dt / 2 * a.w}),
                c = slope(t + dt / 2, {s.q + dt / 2 * b.q, s.w + dt / 2 * b.w}),
                d = slope(t + dt, {s.q + dt * c.q, s.w + dt * c.w});
    s.q += dt / 6 * (a.q + 2 * b.q + 2 * c.q + d.q);
    s.w += dt / 6 * (a.w + 2 * b.w + 2 * c.w + d.w);
  }
  return s;
}

class OfAMode : public ::testing::TestWithParam<Mode> {};

TEST_P(OfAMode, IsTheSameAsManySmallSteps) {
  const ModeResponse r = mode_response(GetParam().stiffness, GetParam().damping, h);
  for (const auto& [q, w, load, load_end] :
       {std::array{1e-3, 0.0, 0.0, 0.0}, std::array{0.0, 0.1, 0.0, 0.0}, std::array{0.0, 0.0, 2.0, 2.0},
        std::array{0.0, 0.0, 0.0, 3.0}, std::array{-2e-3, 0.3, -1.0, 2.0}}) {
    const Swing exact = by_small_steps(GetParam(), {q, w}, load, load_end, 20'000);
    const double scale = std::abs(q) + h * std::abs(w) + h * h * (std::abs(load) + std::abs(load_end));
    EXPECT_NEAR(r.a11 * q + r.a12 * w + r.c0 * load + r.c1 * load_end, exact.q, 1e-10 * scale);
    EXPECT_NEAR(r.a21 * q + r.a22 * w + r.d0 * load + r.d1 * load_end, exact.w,
                1e-10 * scale * (1 / h + std::sqrt(GetParam().stiffness)));
  }
}

INSTANTIATE_TEST_SUITE_P(ModeResponse, OfAMode,
                         ::testing::Values(Mode{0, 0}, Mode{2000, 20}, Mode{1, 0}, Mode{4e4, 400},
                                           Mode{1e4, 5000}, Mode{4e7, 100}, Mode{1, 2e4}));

/// q = (1 - cos(omega h)) / omega^2 under a unit load, without damping.
TEST(ModeResponse, IsThatOfAnUndampedSwing) {
  for (const double omega : {1.0, 60.0, 700.0, 1e4}) {
    const ModeResponse r = mode_response(omega * omega, 0, h);
    EXPECT_NEAR(r.a11, std::cos(omega * h), 1e-11);
    EXPECT_NEAR(r.a12 * omega, std::sin(omega * h), 1e-11);
    EXPECT_NEAR((r.c0 + r.c1) * omega * omega, 1 - std::cos(omega * h), 1e-11);
    EXPECT_NEAR(r.c1 * omega * omega, 1 - std::sin(omega * h) / (omega * h), 1e-11);
  }
}

/// A step is two of half the length.
TEST(ModeResponse, OfTwoHalvesIsThatOfTheWhole) {
  const ModeResponse one = mode_response(9e4, 70, h), half = mode_response(9e4, 70, h / 2);
  double q = 0, w = 0;
  for (const double load : {0.0, 0.5}) {
    const double then = q;
    q = half.a11 * q + half.a12 * w + half.c0 * load + half.c1 * (load + 0.5);
    w = half.a21 * then + half.a22 * w + half.d0 * load + half.d1 * (load + 0.5);
  }
  EXPECT_NEAR(q, one.c1, 1e-13 * h);
  EXPECT_NEAR(w, one.d1, 1e-13);
}

}  // namespace
}  // namespace palpate::haptic
