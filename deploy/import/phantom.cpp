#include "deploy/import/phantom.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/hash.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"
#include "deploy/import/phantom_noise.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

// All lengths here in mm, from the middle of the image.
const Vector3d spacing{0.48, 0.48, 0.6};
const Vector3d sac_axes{6.4, 6.2, 5.1};  // half
constexpr double far_away = 1e6;
constexpr double margin = 1.5;      // how far outside a wall distances are kept
constexpr double neck_blend = 1.0;  // over this length the sac grows out of its vessel

constexpr double tissue = 60, tissue_swing = 10, lumen = 400, lumen_fade = 30, noise = 8;  // intensities

struct Disc {
  Vector3d centre;
  double radius;
};

/// Parent vessel, t from -1 to 1: in at the left, under the sac, out at the right; turned by half about z it is itself.
Disc parent(double t) {
  return {{84 * t, 11 * std::sin(2.2 * std::numbers::pi * t) * std::abs(t), -6.6 - 7 * t * t},
          2.1 - 0.5 * std::abs(t)};
}

/// Branches from the neck, t from 0 to 1; side +1 and -1.
Disc branch(double t, int side) {
  const double s = side;
  return {{s * (6.5 + 34 * t), s * (-2.0 - 30 * t + 9 * std::sin(1.5 * std::numbers::pi * t)),
           -7 + 44 * t * (1.2 - 0.2 * t)},
          1.7 - 0.5 * t};
}

class Walls {
 public:
  explicit Walls(const std::array<int, 3>& size) : size_(size) {
    distance_.assign(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                         static_cast<std::size_t>(size[2]),
                     static_cast<float>(far_away));
  }

  float operator[](std::size_t n) const { return distance_[n]; }

  Vector3d centre_of(int i, int j, int k) const {
    return spacing.cwiseProduct(Vector3d(i - size_[0] / 2, j - size_[1] / 2, k - size_[2] / 2));
  }

  /// A tube along curve(t), made of cones.
  template <class Curve>
  void add_tube(double from, double to, const Curve& curve) {
    constexpr int n_cones = 400;
    Disc a = curve(from);
    for (int n = 1; n <= n_cones; ++n) {
      const Disc b = curve(from + (to - from) * n / n_cones);
      const Vector3d along = b.centre - a.centre;
      const double reach = std::max(a.radius, b.radius) + margin;
      for_box(a.centre.cwiseMin(b.centre).array() - reach, a.centre.cwiseMax(b.centre).array() + reach,
              [&](const Vector3d& p, float& d) {
                const double t = std::clamp((p - a.centre).dot(along) / along.squaredNorm(), 0.0, 1.0);
                const double r = a.radius + t * (b.radius - a.radius);
                d = std::min(d, static_cast<float>((p - a.centre - t * along).norm() - r));
              });
      a = b;
    }
  }

  /// An ellipsoid that blends into what is there:
  ///   smooth minimum   min(a, b) - h^2 / (4 w),   h = max(w - |a - b|, 0)
  /// Source: Quilez, "smooth minimum", polynomial form.
  void add_sac(const Vector3d& middle, const Vector3d& axes) {
    for_box(middle - axes - Vector3d::Constant(margin), middle + axes + Vector3d::Constant(margin),
            [&](const Vector3d& p, float& d) {
              const Vector3d q = (p - middle).cwiseQuotient(axes);
              const Vector3d gradient = q.cwiseQuotient(axes);
              const double f = q.norm();
              // First order: (f - 1) / |grad f|; exact at the wall.
              const double sac = f < 1e-6 ? -axes.minCoeff() : (f - 1) * f / gradient.norm();
              const double other = static_cast<double>(d);
              const double h = std::max(neck_blend - std::abs(sac - other), 0.0);
              d = static_cast<float>(std::min(sac, other) - h * h / (4 * neck_blend));
            });
  }

 private:
  template <class Visit>
  void for_box(const Vector3d& lo, const Vector3d& hi, const Visit& visit) {
    std::array<int, 3> first{}, last{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto e = static_cast<Eigen::Index>(a);
      first[a] = std::max(0, static_cast<int>(std::floor(lo[e] / spacing[e])) + size_[a] / 2);
      last[a] = std::min(size_[a] - 1, static_cast<int>(std::ceil(hi[e] / spacing[e])) + size_[a] / 2);
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const auto row =
              static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j);
          visit(centre_of(i, j, k),
                distance_[row * static_cast<std::size_t>(size_[0]) + static_cast<std::size_t>(i)]);
        }
  }

  std::array<int, 3> size_;
  std::vector<float> distance_;  // to the nearest wall, negative inside
};

double intensity_at(const Vector3d& p, double distance) {
  // Tissue is uneven over centimetres; blood that has been in the slab for long, far from the middle, is darker.
  const double dark = tissue + tissue_swing * std::sin(0.11 * p.x()) * std::cos(0.13 * p.y() + 0.07 * p.z());
  const double bright = lumen - lumen_fade * std::min(1.0, p.norm() / 80);
  const double covered = std::clamp(0.5 - distance / spacing.mean(), 0.0, 1.0);
  return dark + (bright - dark) * covered;
}

}  // namespace

Volume aneurysm_phantom(std::array<int, 3> size) {
  check_size("phantom", {size[0], size[1], size[2]});
  Walls walls(size);
  walls.add_tube(-1, 1, parent);
  for (const int side : {1, -1}) walls.add_tube(0, 1, [&](double t) { return branch(t, side); });
  walls.add_sac(Vector3d::Zero(), sac_axes);
  walls.add_sac({2.6, -1.4, 3.6}, Vector3d::Constant(2.0));  // a bleb on the dome

  Volume volume;
  volume.size = volume.source_size = size;
  volume.spacing = spacing * m_from_mm(1);
  volume.orientation = Eigen::Matrix3d::Identity();
  volume.origin = walls.centre_of(0, 0, 0) * m_from_mm(1);
  volume.source = "phantom aneurysm";
  volume.source_checksum = hash_bytes(size.data(), sizeof(size), hash_text(volume.source));
  volume.transfer = {
      {150, {0.25, 0.02, 0.02, 0}}, {300, {0.75, 0.15, 0.12, 1}}, {420, {0.95, 0.45, 0.38, 1}}};
  volume.intensity.resize(volume.n_cells());
  std::size_t n = 0;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i, ++n) {
        const double clean = intensity_at(walls.centre_of(i, j, k), static_cast<double>(walls[n]));
        const double noisy = clean + noise * noise_at(i - size[0] / 2, j - size[1] / 2, k - size[2] / 2);
        volume.intensity[n] = static_cast<float>(std::max(0.0, std::round(noisy)));
      }
  return volume;
}

}  // namespace palpate
