#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error/error.h"
#include "common/record/volume.h"

namespace palpate {
namespace {

/// Cells of 1, 1.5 and 2 mm with the value f(x, y, z) [mm from the corner] at their centres.
template <class F>
Volume volume_of(std::array<int, 3> size, F f) {
  Volume volume;
  volume.size = volume.source_size = size;
  volume.spacing = {1e-3, 1.5e-3, 2e-3};
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        volume.intensity.push_back(static_cast<float>(f(i + 0.5, 1.5 * (j + 0.5), 2 * (k + 0.5))));
  return volume;
}

double mean_of(const Volume& volume) {
  return std::accumulate(volume.intensity.begin(), volume.intensity.end(), 0.0) /
         static_cast<double>(volume.n_cells());
}

double ramp(double x, double y, double z) { return 100 + 3 * x - 2 * y + 5 * z; }
double rough(double x, double y, double z) {
  return 50 * std::sin(7 * x) + 30 * std::cos(3 * x * y) + 40 * std::sin(z * z);
}

double worst_on_ramp(const Volume& v, int rim) {
  double worst = 0;
  for (int k = rim; k < v.size[2] - rim; ++k)
    for (int j = rim; j < v.size[1] - rim; ++j)
      for (int i = rim; i < v.size[0] - rim; ++i) {
        const Eigen::Vector3d p = 1e3 * v.spacing.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
        worst = std::max(worst, std::abs(static_cast<double>(v.at(i, j, k)) - ramp(p[0], p[1], p[2])));
      }
  return worst;
}

constexpr std::array<int, 3> size = {17, 12, 9};
constexpr double rounding = 6e-5;  // of floats near 200

TEST(Resample, KeepsConstants) {
  const Volume volume = volume_of(size, [](double, double, double) { return 42.0; });
  for (const std::array<int, 3>& partition :
       {std::array<int, 3>{5, 7, 4}, {40, 13, 9}, {1, 1, 1}, {17, 30, 2}})
    for (const float value : resample(volume, partition).intensity) ASSERT_NEAR(value, 42.0f, 1e-5f);
}

TEST(Resample, KeepsRampsExactlyWhereCellsGrow) {
  const Volume volume = volume_of(size, ramp);
  for (const std::array<int, 3>& partition :
       {std::array<int, 3>{8, 5, 4}, {16, 11, 8}, {3, 2, 2}, {17, 6, 3}})
    EXPECT_LT(worst_on_ramp(resample(volume, partition), 0), rounding);
}

// The cells at the rim have centres beyond the outermost old centres; they take the outermost values.
TEST(Resample, KeepsRampsExactlyWithinTheRimWhereCellsShrink) {
  const Volume volume = volume_of(size, ramp);
  EXPECT_LT(worst_on_ramp(resample(volume, {34, 24, 18}), 1), rounding);
  EXPECT_LT(worst_on_ramp(resample(volume, {23, 17, 13}), 1), rounding);
  EXPECT_GT(worst_on_ramp(resample(volume, {34, 24, 18}), 0), 0.1);
}

TEST(Resample, KeepsTheMean) {
  const Volume volume = volume_of(size, rough);
  const double mean = mean_of(volume);
  for (const std::array<int, 3>& partition :
       {std::array<int, 3>{5, 7, 4}, {16, 11, 8}, {1, 1, 1}, {34, 24, 27}, {51, 5, 18}})
    EXPECT_NEAR(mean_of(resample(volume, partition)), mean, 1e-5) << partition[0];
}

TEST(Resample, InventsNoValuesOutsideTheRange) {
  const Volume volume =
      volume_of(size, [](double x, double y, double) { return x > 7.2 && y > 3 ? 3000.0 : -1000.0; });
  for (const std::array<int, 3>& partition : {std::array<int, 3>{5, 7, 4}, {16, 11, 8}, {40, 30, 20}}) {
    const auto [lo, hi] = std::ranges::minmax(resample(volume, partition).intensity);
    EXPECT_GE(lo, -1000.01f);
    EXPECT_LE(hi, 3000.01f);
  }
}

TEST(Resample, KeepsThePlaceAndTheLength) {
  Volume volume = volume_of(size, ramp);
  volume.origin = {0.1, 0.2, 0.3};
  volume.orientation = Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix();
  const Volume coarse = resample(volume, {5, 4, 3});
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    EXPECT_DOUBLE_EQ(coarse.spacing[axis] * coarse.size[a], volume.spacing[axis] * volume.size[a]);
    const double sign = axis == 1 ? -1 : 1;  // the corner, half a cell before the first centre, stays
    EXPECT_NEAR(coarse.origin[axis] - sign * 0.5 * coarse.spacing[axis],
                volume.origin[axis] - sign * 0.5 * volume.spacing[axis], 1e-15);
  }
  EXPECT_EQ(coarse.source_size, size);
  EXPECT_EQ(resample(volume, size).intensity, volume.intensity);
}

TEST(Resample, RefusesAbsurdPartitions) {
  const Volume volume = volume_of(size, ramp);
  EXPECT_THROW(resample(volume, {0, 5, 5}), InputError);
  EXPECT_THROW(resample(volume, {-3, 5, 5}), InputError);
  EXPECT_THROW(resample(volume, {1000, 1000, 1000}), InputError);
  EXPECT_THROW(resample(volume, {2'000'000'000, 2'000'000'000, 2}), InputError);
}

}  // namespace
}  // namespace palpate
