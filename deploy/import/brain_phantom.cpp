#include "deploy/import/brain_phantom.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/error/error.h"
#include "deploy/import/phantom_noise.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

// All lengths here in mm, from the middle of the image: x to the right of the picture, y to the front, z up.
const Vector3d cerebrum{68, 84, 62};  // half axes
const Vector3d cerebrum_middle{0, 0, 12};
constexpr double cortex = 4.5, groove = 11, fissure = 1.6;
constexpr double white = 200, grey = 130, fluid = 25, noise = 4;  // intensities
constexpr int per_side = 2;  // a pixel is the mean of so many points each way

double ellipsoid(const Vector3d& p, const Vector3d& middle, const Vector3d& axes) {
  return (p - middle).cwiseQuotient(axes).norm();  // 1 on its surface
}

/// Where the cortex folds inwards: 1 in the middle of a sulcus, 0 on a gyrus. Waves over the directions from the middle, bent by
/// other waves, as wide as `width` says.
double sulcus(const Vector3d& from_middle, double width) {
  const Vector3d u = from_middle.normalized();
  const double side = u.x() > 0 ? 0.7 : 0.0;  // the hemispheres are not the same
  const double a =
      2.1 * std::sin(4.2 * u.y() + 2.6 * u.z() + side) + 1.3 * std::sin(6.1 * u.z() - 3.3 * u.y() + 2 * side);
  const double wave = std::sin(13 * u.y() + a) * std::cos(9 * u.z() + 0.8 * a + side) +
                      0.45 * std::sin(11 * std::abs(u.x()) + 1.7 * a);
  return std::exp(-std::pow(wave / width, 2));
}

double cerebrum_at(const Vector3d& p) {
  const Vector3d from_middle = p - cerebrum_middle;
  const double radius = from_middle.norm();
  if (radius < 1e-9) return white;
  const double q = ellipsoid(p, cerebrum_middle, cerebrum);
  const double depth = (1 / q - 1) * radius;  // below the smooth hull, along the radius
  // The fissure ends on the corpus callosum, which joins the hemispheres.
  const bool joined = ellipsoid(p, {0, 2, 4}, {14, 34, 12}) < 1;
  const double from_fissure = joined ? 1e3 : std::abs(p.x()) - fissure;
  if (depth < groove * sulcus(from_middle, 0.16) || from_fissure < 0) return fluid;
  const bool under_cortex =
      depth > cortex + (groove + cortex) * sulcus(from_middle, 0.42) && from_fissure > cortex;
  return under_cortex ? white : grey;
}

bool in_ventricle(const Vector3d& p) {
  const Vector3d mirrored(std::abs(p.x()), p.y(), p.z());
  return ellipsoid(mirrored, {9, 4, 14}, {5, 26, 6}) < 1 || ellipsoid(mirrored, {16, -24, 8}, {5, 12, 9}) < 1;
}

/// Thin leaves, one above the other, on a core of white matter.
double cerebellum_at(const Vector3d& p) {
  const Vector3d mirrored(std::abs(p.x()), p.y(), p.z());
  const double q =
      std::min(ellipsoid(mirrored, {22, -40, -42}, {30, 26, 20}), ellipsoid(p, {0, -38, -42}, {14, 24, 17}));
  const double leaf = std::abs(std::sin(0.55 * (p.z() + 0.35 * p.y())));
  if (q > 1 - 0.10 * (1 - leaf)) return 0;
  return q < 0.55 || (leaf > 0.8 && q < 0.85) ? white : grey;
}

double intensity_at(const Vector3d& p) {
  const double around = ellipsoid(p, {0, 0, 6}, {73, 89, 72});
  const double outside = around < 1 ? fluid : 0;
  const bool stem = std::hypot(p.x(), (p.y() + 14 + 0.15 * p.z()) / 1.1) < 10 && p.z() < -8 && p.z() > -78;
  if (stem) return white;
  if (ellipsoid(p, cerebrum_middle, cerebrum) < 1 && p.z() > -38 - 0.12 * p.y() - (p.y() < -22 ? -14 : 0)) {
    if (in_ventricle(p)) return fluid;
    return cerebrum_at(p);
  }
  return std::max(outside, cerebellum_at(p));
}

}  // namespace

std::vector<GreyPicture> brain_phantom() {
  std::vector<GreyPicture> slices;
  const Vector3d spacing(brain_pixel_mm, brain_pixel_mm, brain_plane_mm);
  for (int k = 0; k < brain_planes; ++k) {
    GreyPicture& slice = slices.emplace_back(GreyPicture{brain_width, brain_height, 8, {}});
    for (int row = 0; row < brain_height; ++row)
      for (int i = 0; i < brain_width; ++i) {
        const int j = brain_height - 1 - row;
        double sum = 0;
        for (int s = 0; s < per_side * per_side * per_side; ++s) {
          const Vector3d within(s % per_side, s / per_side % per_side, s / per_side / per_side);
          const Vector3d at = Vector3d(i, j, k) + (within + Vector3d::Constant(0.5)) / per_side -
                              0.5 * Vector3d(brain_width, brain_height, brain_planes);
          sum += intensity_at(spacing.cwiseProduct(at));
        }
        const double clean = sum / (per_side * per_side * per_side);
        const double value = clean > 0 ? clean + noise * noise_at(i, j, k) : 0;
        slice.value.push_back(static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, 255.0)));
      }
  }
  return slices;
}

void write_brain_phantom(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directory(folder, error);
  if (!fs::is_directory(folder, error))
    throw InputError(folder + ": is no folder and cannot be made; name a folder in one that is there");
  const auto slices = brain_phantom();
  for (std::size_t k = 0; k < slices.size(); ++k)
    write_grey_png(slices[k], (fs::path(folder) / fmt::format("slice_{:02}.png", k)).string());
}

}  // namespace palpate
