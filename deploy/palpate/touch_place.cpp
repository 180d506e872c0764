#include "deploy/palpate/touch_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace palpate::deploy {
namespace {

using physics::Cells;

constexpr int rays_across = 32;            // of the image, along each of two axes
constexpr double least_even = 0.6;         // Why: an edge of a box has 0.5 and more, a plane 1
constexpr double least_along = 0.5;        // cosine. Why: flatter to the axis, another one meets it better
constexpr double least_cells_thick = 1.8;  // Why: a wall of one cell bends inside out
constexpr double ray_step = 0.05;          // of a cell
constexpr std::size_t most_faces = 20000;

bool is_filled_at(const Cells& cells, const Vec3& p) {
  const Vec3i at = cells.cell_at(p);
  return cells.is_filled(at.x(), at.y(), at.z());
}

/// Calls visit(centre, outward) for the faces between tissue and none of a cell.
template <class Visit>
void for_each_face(const Cells& cells, const Vec3i& cell, const Visit& visit) {
  if (!cells.is_filled(cell.x(), cell.y(), cell.z())) return;
  const Vec3 centre = cells.centre_of(cell.x(), cell.y(), cell.z());
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const Vec3i beside = cell + side * Vec3i::Unit(axis);
      if (cells.is_filled(beside.x(), beside.y(), beside.z())) continue;
      visit(Vec3(centre + 0.5 * side * cells.spacing[axis] * Vec3::Unit(axis)),
            Vec3(side * Vec3::Unit(axis)));
    }
}

struct MeanNormal {
  Vec3 outward = Vec3::Zero();  // unit; 0: they face all ways
  double even = 0;              // 1 of any plane, however its faces are stepped
};

/// sum w n over sum w, w = area (1 - r^2 / R^2)^2 within R = two radii, of the faces that do not face away, as the
/// tip feels them. Steps of a plane with normal m have areas in proportion to |m_x|, |m_y|, |m_z|, so the sum of the
/// magnitudes of its components is that of their areas.
MeanNormal mean_normal(const Cells& cells, const Vec3& at, const Vec3& facing, double tip_radius) {
  const double reach = 2 * std::max(tip_radius, cells.spacing.maxCoeff());
  const Vec3i lo = cells.cell_at(at - Vec3::Constant(reach)), hi = cells.cell_at(at + Vec3::Constant(reach));
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (int k = lo.z(); k <= hi.z(); ++k)
    for (int j = lo.y(); j <= hi.y(); ++j)
      for (int i = lo.x(); i <= hi.x(); ++i)
        for_each_face(cells, {i, j, k}, [&](const Vec3& centre, const Vec3& normal) {
          const double r2 = (centre - at).squaredNorm() / (reach * reach);
          if (r2 >= 1 || normal.dot(facing) < -0.2) return;
          const double w = (1 - r2) * (1 - r2) * cells.spacing.prod() / normal.cwiseAbs().dot(cells.spacing);
          sum += w * normal;
          weights += w;
        });
  if (sum.norm() < 0.1 * weights || !(weights > 0)) return {};
  return {sum.normalized(), sum.cwiseAbs().sum() / weights};
}

/// Is a ball free of tissue, but for corners of cells that are cut by less than a tenth of its radius?
bool is_free(const Cells& cells, const Vec3& middle, double radius) {
  const double free = 0.9 * radius;
  const Vec3i lo = cells.cell_at(middle - Vec3::Constant(free)),
              hi = cells.cell_at(middle + Vec3::Constant(free));
  for (int k = lo.z(); k <= hi.z(); ++k)
    for (int j = lo.y(); j <= hi.y(); ++j)
      for (int i = lo.x(); i <= hi.x(); ++i) {
        if (!cells.is_filled(i, j, k)) continue;
        const Vec3 off = (middle - cells.centre_of(i, j, k)).cwiseAbs() - 0.5 * cells.spacing;
        if (off.cwiseMax(0.0).norm() < free) return false;
      }
  return true;
}

/// The first of tissue on the way in from so far outside.
std::optional<Vec3> first_met(const Cells& cells, const Vec3& from, const Vec3& inward, double farthest) {
  const double step = ray_step * cells.spacing.minCoeff();
  for (double s = 0; s <= farthest; s += step)
    if (is_filled_at(cells, from + s * inward)) {
      double out = s - step, in = s;
      for (int n = 0; n < 20; ++n)
        (is_filled_at(cells, from + 0.5 * (out + in) * inward) ? in : out) = 0.5 * (out + in);
      return from + in * inward;
    }
  return std::nullopt;
}

/// Is there no more tissue on the way out of the image? A cavity is no outside.
bool leads_out(const Cells& cells, const Vec3& from, const Vec3& outward) {
  const double step = 0.5 * cells.spacing.minCoeff();
  const double size = cells.spacing.cwiseProduct(cells.size.cast<double>()).norm();
  for (double s = 0; s <= size; s += step)
    if (is_filled_at(cells, from + s * outward)) return false;
  return true;
}

/// Can a tip come to this face along the normal there? @param even  receives how even the surface is
std::optional<TouchPlace> reached(const Cells& cells, const Vec3& face, const Vec3& facing, double tip_radius,
                                  double& even) {
  const MeanNormal normal = mean_normal(cells, face, facing, tip_radius);
  even = normal.even;
  if (normal.outward.isZero() || normal.outward.dot(facing) < 0.1) return std::nullopt;
  const double away = approach_length(tip_radius);
  const auto at =
      first_met(cells, face + away * normal.outward, -normal.outward, away + cells.spacing.maxCoeff());
  if (!at || (*at - face).norm() > cells.spacing.norm()) return std::nullopt;
  for (double tip = tip_radius; tip <= away * (1 + 1e-9); tip += 0.5 * tip_radius)
    if (!is_free(cells, *at + (tip + tip_radius) * normal.outward, tip_radius)) return std::nullopt;
  if (!leads_out(cells, *at + away * normal.outward, normal.outward)) return std::nullopt;
  const double step = ray_step * cells.spacing.minCoeff();
  TouchPlace place{*at, normal.outward, 0, cells.cell_at(*at - 1e-3 * step * normal.outward)};
  if (!cells.is_filled(place.cell.x(), place.cell.y(), place.cell.z())) return std::nullopt;
  while (place.thickness < most_looked_through(tip_radius) &&
         is_filled_at(cells, *at - (place.thickness + step) * normal.outward))
    place.thickness += step;
  if (place.thickness < least_cells_thick * cells.spacing.maxCoeff()) return std::nullopt;
  return place;
}

/// Tissue that reaches the end of the image on this side was cut there.
std::optional<Vec3i> first_cell(const Cells& cells, Vec3i cell, Eigen::Index axis, int inward) {
  for (bool at_end = true; cells.inside(cell.x(), cell.y(), cell.z()); cell[axis] += inward, at_end = false)
    if (cells.is_filled(cell.x(), cell.y(), cell.z())) return at_end ? std::nullopt : std::optional(cell);
  return std::nullopt;
}

}  // namespace

std::optional<TouchPlace> best_place(const Cells& cells, double tip_radius) {
  std::optional<TouchPlace> best;
  double most = -1;
  const Vec3 half = 0.5 * cells.spacing.cwiseProduct(cells.size.cast<double>()), middle = cells.corner + half;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const Eigen::Index b = (axis + 1) % 3, c = (axis + 2) % 3;
      for (int n = 0; n < rays_across * rays_across; ++n) {
        Vec3i cell;
        cell[axis] = side < 0 ? 0 : cells.size[axis] - 1;
        cell[b] = static_cast<int>((n % rays_across + 0.5) * cells.size[b] / rays_across);
        cell[c] = static_cast<int>((n / rays_across + 0.5) * cells.size[c] / rays_across);
        const auto met = first_cell(cells, cell, axis, -side);
        if (!met) continue;
        const Vec3 facing = side * Vec3::Unit(axis);
        const Vec3 face = cells.centre_of(met->x(), met->y(), met->z()) + 0.5 * cells.spacing[axis] * facing;
        double even = 0;
        const auto place = reached(cells, face, facing, tip_radius, even);
        if (!place || even < least_even || place->outward.dot(facing) < least_along) continue;
        const Vec3 off = (place->at - middle).cwiseQuotient(half);
        const double aside = std::hypot(off[b], off[c]);
        const double score = place->thickness / most_looked_through(tip_radius) + even - 0.5 * aside;
        if (score > most) most = score, best = place;
      }
    }
  return best;
}

std::optional<TouchPlace> place_near(const Cells& cells, const Vec3& p, double tip_radius) {
  struct Face {
    double distance;
    Vec3 centre, outward;
  };
  std::vector<Face> faces;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i)
        for_each_face(cells, {i, j, k}, [&](const Vec3& centre, const Vec3& outward) {
          const Vec3i out = cells.cell_at(centre + 0.5 * outward.cwiseProduct(cells.spacing));
          if (cells.inside(out.x(), out.y(), out.z()))
            faces.push_back({(centre - p).norm(), centre, outward});
        });
  const auto nearest = faces.begin() + static_cast<std::ptrdiff_t>(std::min(most_faces, faces.size()));
  std::partial_sort(faces.begin(), nearest, faces.end(),
                    [](const Face& a, const Face& b) { return a.distance < b.distance; });
  for (auto face = faces.begin(); face != nearest; ++face) {
    double even = 0;
    if (const auto place = reached(cells, face->centre, face->outward, tip_radius, even)) return place;
  }
  return std::nullopt;
}

}  // namespace palpate::deploy
