#include "haptic_node/tissue/surface_touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "tests/unit/haptic_node/tissue/some_surfaces.h"

namespace palpate::haptic {
namespace {

constexpr double h = 1e-3;

/// Presses, and slides in a bow; out of the tissue up to 100 ms.
Vec3 tip_at(int n) {
  const double t = h * n;
  return Vec3(12e-3 + 4e-3 * std::sin(4 * t), 13e-3 + 3e-3 * std::sin(3 * t),
              t < 0.2 ? -3e-3 * std::sin(10 * (t - 0.1)) : -3e-3);
}

/// Answers of physics that is the model itself come 40 ticks late, by every tenth sample: what is felt is what it bears.
TEST(SurfaceTouch, FeelsNowWhatIsToldLate) {
  for (const double friction : {0.0, 0.4}) {
    const SurfaceModel model = soft_surface(friction);
    const SurfaceStep physics(model, {500, 1}, h);
    SurfaceTouch touch({{500, 1}, h, 10, 0});
    SurfaceState truth;
    truth.xi = SurfacePlace(3, 3.25);
    std::vector<SurfaceState> history(1, truth);
    double most = 0, aside = 0;
    const auto answer = std::make_unique<SurfaceAnswer>();
    answer->model = model;
    for (int n = 1; n <= 1000; ++n) {
      if (n > 41 && n % 10 == 1) {
        answer->stamp = static_cast<std::uint64_t>(n - 41);
        answer->state = history[answer->stamp];
        ASSERT_TRUE(touch.take(*answer));
      }
      touch.tick(tip_at(n), 1);
      physics.advance(model, truth, touch.history().at(static_cast<std::uint64_t>(n)));
      history.push_back(truth);
      if (n < 52) continue;
      ASSERT_NEAR((touch.felt_state().force - truth.force).norm(), 0, 1e-9) << n;
      ASSERT_NEAR((touch.felt_state().xi - truth.xi).norm(), 0, 1e-9) << n;
      most = std::max(most, -truth.force.z());
      aside = std::max(aside, truth.force.head<2>().norm());
    }
    EXPECT_GT(most, 0.5);
    EXPECT_GT(aside, friction > 0 ? 0.1 : 0.01);
  }
}

TEST(SurfaceTouch, RefusesWhatItCannotReplay) {
  SurfaceTouch touch({{500, 1}, h, 10, 0});
  const auto answer = std::make_unique<SurfaceAnswer>();
  answer->model = soft_surface(0.3);
  answer->stamp = 1;
  EXPECT_FALSE(touch.take(*answer));  // of a sample to come
  for (std::uint64_t n = 0; n <= TipHistory::kept; ++n) touch.tick(Vec3(0.012, 0.012, 0.01), 1);
  EXPECT_FALSE(touch.take(*answer));  // that is forgotten
  answer->stamp = 2;
  EXPECT_TRUE(touch.take(*answer));
}

/// Tissue that comes up under a tip comes without a jump, and its energy is paid.
TEST(SurfaceTouch, BringsTissueUpGently) {
  SurfaceTouch touch({{500, 1}, h, 10, 0});
  const auto answer = std::make_unique<SurfaceAnswer>();
  answer->model = soft_surface(0.3);
  answer->state.xi = SurfacePlace(3, 3);
  const Vec3 tip(12e-3, 12e-3, -5e-3);
  touch.tick(tip, 1);
  answer->stamp = 1;
  ASSERT_TRUE(touch.take(*answer));
  double before = 0, most = 0;
  for (int n = 0; n < 2000; ++n) {
    const double force = touch.tick(tip, 1).norm();
    EXPECT_LE(force - before, TissueTouch::slew * h + 0.02);
    EXPECT_LE(touch.correction_work(), WorkTank::capacity + WorkTank::trickle * h * (n + 1) + 1e-12);
    before = force;
    most = std::max(most, force);
  }
  EXPECT_GT(most, 0.3);
}

}  // namespace
}  // namespace palpate::haptic
