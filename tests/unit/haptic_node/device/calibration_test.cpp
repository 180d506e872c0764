#include "haptic_node/device/calibration.h"
#include "common/scene/device_spec.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "common/error/error.h"

namespace palpate::haptic {
namespace {

DeviceSpec random_spec(std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  DeviceSpec spec;
  spec.name = "hand";
  spec.rotation =
      Eigen::Quaterniond(u(random), u(random), u(random), u(random)).normalized().toRotationMatrix();
  spec.scale = std::pow(10.0, u(random));
  spec.force_scale = std::pow(10.0, u(random));
  spec.offset = {u(random), u(random), u(random)};
  return spec;
}

TEST(Calibration, GoesThereAndBack) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Calibration calibration(random_spec(random));
    const Vec3 x(u(random), u(random), u(random));
    EXPECT_LT((calibration.device_from_world(calibration.world_from_device(x)) - x).norm(), 1e-12 * 20);
    EXPECT_LT((calibration.force_to_world(calibration.force_to_device(x)) - x).norm(), 1e-12);
  }
}

TEST(Calibration, TurnsForcesBackByTheTransposeAndScalesThem) {
  std::mt19937_64 random(2);
  const DeviceSpec spec = random_spec(random);
  const Calibration calibration(spec);
  const Vec3 f(1, -2, 3);
  EXPECT_LT((calibration.force_to_device(f) - spec.force_scale * spec.rotation.transpose() * f).norm(),
            1e-12);
}

TEST(Calibration, KeepsTheRatioOfEnergies) {
  std::mt19937_64 random(3);
  const DeviceSpec spec = random_spec(random);
  const Calibration calibration(spec);
  const Vec3 f_w(1, -2, 3), dx_d(1e-3, 2e-3, -1e-3);
  const double e_d = calibration.force_to_device(f_w).dot(dx_d);
  const double e_w = f_w.dot(calibration.velocity_to_world(dx_d));
  EXPECT_NEAR(e_d, spec.force_scale / spec.scale * e_w, 1e-12);
}

TEST(Calibration, AcceptsThreeDigitsWrittenByHandAndMakesThemExact) {
  DeviceSpec spec;
  spec.rotation << 0.707, -0.707, 0, 0.707, 0.707, 0, 0, 0, 1;
  const Eigen::Matrix3d r = Calibration(spec).rotation();
  EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(Calibration, RefusesWhatIsNoCalibration) {
  const auto refused = [](auto&& spoil) {
    DeviceSpec spec;
    spec.name = "hand";
    spec.place = {"a.toml", 3, 1};
    spoil(spec);
    try {
      Calibration calibration(spec);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refused([](DeviceSpec&) {}), "");
  EXPECT_NE(refused([](DeviceSpec& s) { s.rotation(2, 2) = -1; }).find("mirrors"), std::string::npos);
  EXPECT_NE(refused([](DeviceSpec& s) { s.rotation(0, 1) = 0.1; }).find("a.toml:3:1"), std::string::npos);
  EXPECT_NE(refused([](DeviceSpec& s) { s.rotation(0, 0) = std::nan(""); }), "");
  EXPECT_NE(refused([](DeviceSpec& s) { s.scale = 0; }).find("scale is 0"), std::string::npos);
  EXPECT_NE(refused([](DeviceSpec& s) { s.force_scale = -1; }), "");
  EXPECT_NE(refused([](DeviceSpec& s) { s.offset.x() = std::numeric_limits<double>::infinity(); }), "");
}

}  // namespace
}  // namespace palpate::haptic
