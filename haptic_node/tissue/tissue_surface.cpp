#include "haptic_node/tissue/tissue_surface.h"

#include <algorithm>
#include <cmath>

#include "haptic_node/tissue/spline_weights.h"
#include "haptic_node/tissue/tissue_bounds.h"

namespace palpate::haptic {
namespace {

constexpr int farthest_node = 1'000'000;

Mat3 symmetric(const std::array<double, 6>& s) noexcept {
  Mat3 m;
  m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return m;
}

/// R, and half its derivatives times F added to the tangents.
void add_residual(const SurfaceModel& model, const Vec3& local, const Vec3& force,
                  SurfacePoint& point) noexcept {
  const SplineWeights a(SurfaceModel::finer * local.x(), model.fine(0)),
      b(SurfaceModel::finer * local.y(), model.fine(1));
  std::array<double, 6> sum{}, by_a{}, by_b{};
  for (std::size_t j = 0; j < 4; ++j) {
    const int row = (b.first + static_cast<int>(j)) * model.fine(0) + a.first;
    std::array<double, 6> along{}, slope{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& c = model.residual[static_cast<std::size_t>(row) + i];
      for (std::size_t k = 0; k < 6; ++k) along[k] += a.w[i] * c[k], slope[k] += a.dw[i] * c[k];
    }
    for (std::size_t k = 0; k < 6; ++k) {
      sum[k] += b.w[j] * along[k];
      by_a[k] += b.w[j] * slope[k];
      by_b[k] += b.dw[j] * along[k];
    }
  }
  point.residual = symmetric(sum);
  point.tangents[0] += 0.5 * SurfaceModel::finer * (symmetric(by_a) * force);
  point.tangents[1] += 0.5 * SurfaceModel::finer * (symmetric(by_b) * force);
}

/// Not below 0 in any direction, but for rounding; splines of such matrices are such.
bool is_compliance(const std::array<double, 6>& s) noexcept {
  for (std::size_t k = 0; k < 6; ++k)
    if (!within(s[k], k < 3 ? 0.0 : -1.0, 1.0)) return false;
  constexpr double rounding = 1e-9;
  const double size = s[0] + s[1] + s[2], least = -rounding * size * size;
  return s[0] * s[1] - s[3] * s[3] >= least && s[0] * s[2] - s[4] * s[4] >= least &&
         s[1] * s[2] - s[5] * s[5] >= least && symmetric(s).determinant() >= least * size;
}

bool is_sound(const SurfaceModel& m) noexcept {
  if (m.n_modes > SurfaceModel::most_modes || !within(m.friction, 0, largest_friction)) return false;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (m.sides[axis] < SurfaceModel::least_side || m.sides[axis] > SurfaceModel::most_side) return false;
    if (m.origin[axis] < -farthest_node || m.origin[axis] > farthest_node) return false;
  }
  for (std::uint32_t i = 0; i < m.n_modes; ++i)
    if (!within(m.modes[i].stiffness, 0, stiffest_mode) || !within(m.modes[i].damping, 0, most_mode_damping))
      return false;
  for (int n = 0; n < m.sides[0] * m.sides[1]; ++n) {
    const SurfaceModel::Node& node = m.nodes[static_cast<std::size_t>(n)];
    if (!within(node.rest, farthest_hand)) return false;
    for (std::uint32_t i = 0; i < m.n_modes; ++i)
      if (!within(node.shapes[i], largest_shape)) return false;
  }
  for (int n = 0; n < m.fine(0) * m.fine(1); ++n)
    if (!is_compliance(m.residual[static_cast<std::size_t>(n)])) return false;
  return true;
}

}  // namespace

SurfacePlace SurfacePoint::places_along(const Vec3& way) const noexcept {
  const double aa = tangents[0].squaredNorm(), bb = tangents[1].squaredNorm(),
               ab = tangents[0].dot(tangents[1]);
  const double det = aa * bb - ab * ab;
  if (!(det > 1e-6 * aa * bb)) return SurfacePlace::Zero();
  const double a = tangents[0].dot(way), b = tangents[1].dot(way);
  return SurfacePlace((bb * a - ab * b) / det, (aa * b - ab * a) / det);
}

SurfacePlace on_patch(const SurfaceModel& model, const SurfacePlace& xi) noexcept {
  const auto bounded = [&](std::size_t axis) {
    const double first = model.origin[axis] + 1.0, last = model.origin[axis] + model.sides[axis] - 2.0;
    return std::clamp(xi[static_cast<Eigen::Index>(axis)], first, last);
  };
  return SurfacePlace(bounded(0), bounded(1));
}

SurfacePoint surface_point(const SurfaceModel& model, const std::array<double, SurfaceModel::most_modes>& q,
                           const Vec3& rest, const SurfacePlace& xi, const Vec3& force) noexcept {
  SurfacePoint point;
  const Vec3 local(xi.x() - model.origin[0], xi.y() - model.origin[1], 0);
  const SplineWeights a(local.x(), model.sides[0]), b(local.y(), model.sides[1]);
  point.modal = rest;
  for (Vec3& t : point.tangents) t.setZero();
  for (std::uint32_t i = 0; i < model.n_modes; ++i) point.psi[i].setZero();
  for (std::size_t j = 0; j < 4; ++j) {
    const int row = (b.first + static_cast<int>(j)) * model.sides[0] + a.first;
    for (std::size_t k = 0; k < 4; ++k) {
      const SurfaceModel::Node& node = model.nodes[static_cast<std::size_t>(row) + k];
      const double weight = a.w[k] * b.w[j];
      Vec3 lies = node.rest;
      for (std::uint32_t i = 0; i < model.n_modes; ++i) {
        lies += q[i] * node.shapes[i];
        point.psi[i] += weight * node.shapes[i];
      }
      point.modal += weight * lies;
      point.tangents[0] += a.dw[k] * b.w[j] * lies;
      point.tangents[1] += a.w[k] * b.dw[j] * lies;
    }
  }
  add_residual(model, local, force, point);
  const Vec3 across = point.tangents[0].cross(point.tangents[1]);
  const double size = across.norm();
  point.normal = size > 0 ? Vec3(across / size) : Vec3(Vec3::UnitZ());
  return point;
}

bool is_sound(const SurfaceAnswer& answer, std::uint32_t tool) noexcept {
  if (answer.tool != tool || !is_sound(answer.model)) return false;
  const SurfaceState& s = answer.state;
  for (std::uint32_t i = 0; i < answer.model.n_modes; ++i)
    if (!within(s.q[i], largest_state) || !within(s.w[i], largest_state)) return false;
  return within(s.xi.x(), farthest_node) && within(s.xi.y(), farthest_node) &&
         within(s.rest, farthest_hand) && within(s.force, strongest_tissue);
}

}  // namespace palpate::haptic
