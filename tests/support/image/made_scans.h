#pragma once
// Scans of known bodies: what is air and tissue in them, and how far a point is from the surface.

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "common/math/vec3.h"
#include "common/record/volume.h"

namespace palpate::test {

struct MadeScan {
  std::string name;
  Volume volume;
  std::function<double(const Vec3&)>
      above_surface;  // of a point in the world of a scene [m]; below 0: in tissue
};

inline double normal(double mean, double deviation) {
  static std::mt19937 random(1);
  return std::normal_distribution<double>(mean, deviation)(random);
}

/// @param intensity  at a point from the middle of the image, along its axes [m]
inline Volume scan_of(std::array<int, 3> size, const Vec3& spacing,
                      const std::function<double(const Vec3&)>& intensity) {
  Volume volume;
  volume.size = volume.source_size = size;
  volume.spacing = spacing;
  volume.source = "made";
  const Vec3 half = 0.5 * Vec3(size[0], size[1], size[2]);
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        volume.intensity.push_back(
            static_cast<float>(intensity(spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5) - half))));
  volume.transfer = default_transfer(-1000, 1000);
  return volume;
}

inline double above_ball(const Vec3& p, double radius) { return p.norm() - radius; }

/// Skin, a shell of bone, brain; below it a table that is no part of the patient. Noise of 20 HU.
inline MadeScan ct_head() {
  const auto above = [](const Vec3& p) { return above_ball(p, 0.070); };
  return {
      "CtHead",
      scan_of({96, 96, 64}, {0.0018, 0.0018, 0.0025},
              [=](const Vec3& p) {
                const double d = above(p);
                const bool table = p.y() > 0.074 && p.y() < 0.078;
                const double hu = d > 0 ? (table ? 200 : -1000) : d > -0.006 ? 20 : d > -0.013 ? 1200 : 40;
                return std::round(normal(hu, 20));
              }),
      above};
}

/// The background is the magnitude of noise; the tissue fades to a third across the image.
inline MadeScan mr_with_bias() {
  const auto above = [](const Vec3& p) { return above_ball(p, 0.055); };
  return {"MrWithBias",
          scan_of({128, 128, 80}, {0.0012, 0.0012, 0.002},
                  [=](const Vec3& p) {
                    const double coil = 1 - 0.33 * (1 + p.x() / 0.055);
                    const double signal = above(p) > 0 ? 0 : coil * (above(p) > -0.01 ? 500 : 350);
                    return std::round(std::hypot(normal(signal, 12), normal(0, 12)));
                  }),
          above};
}

/// Of patient directions that lie askew and are left-handed, so that the world turns x round: a ball off the middle.
inline MadeScan oblique_left_handed() {
  const Vec3 centre(0.012, -0.006, 0.004);
  MadeScan scan{
      "ObliqueLeftHanded",
      scan_of({90, 80, 70}, Vec3::Constant(0.001),
              [=](const Vec3& p) { return above_ball(p - centre, 0.022) > 0 ? 3.0 : 200.0; }),
      [=](const Vec3& p) { return above_ball(p - Vec3(-centre.x(), centre.y(), centre.z()), 0.022); }};
  Eigen::Matrix3d axes = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  axes.col(2) *= -1;
  scan.volume.orientation = axes;
  return scan;
}

inline MadeScan tenth_of_a_millimetre() {
  const auto above = [](const Vec3& p) { return above_ball(p, 0.0035); };
  return {"TenthOfAMillimetre",
          scan_of({96, 96, 96}, Vec3::Constant(0.0001),
                  [=](const Vec3& p) { return std::round(normal(above(p) > 0 ? 5000 : 20000, 400)); }),
          above};
}

/// A forearm along z, cut at both ends of the image.
inline MadeScan anisotropic() {
  const auto above = [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 0.03; };
  return {"Anisotropic",
          scan_of({90, 90, 30}, {0.001, 0.001, 0.003},
                  [=](const Vec3& p) {
                    return above(p) > 0 ? -1000.0 : std::hypot(p.x() - 0.005, p.y()) < 0.006 ? 900.0 : 50.0;
                  }),
          above};
}

/// Intensities of an unknown unit, all of them below 0, and fractions.
inline MadeScan all_negative() {
  const auto above = [](const Vec3& p) { return above_ball(p, 0.04); };
  return {"AllNegative",
          scan_of({70, 70, 70}, Vec3::Constant(0.0015),
                  [=](const Vec3& p) { return normal(above(p) > 0 ? -8.25 : -3.5, 0.4); }),
          above};
}

}  // namespace palpate::test
