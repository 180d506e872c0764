#include "physics_node/contact/stick_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {
namespace {

constexpr double side_limit = 0.2;          // cosine below which a facet belongs to another side
constexpr std::size_t most_facets = 16384;  // facets that it may touch at the most

}  // namespace

StickSurface::StickSurface(const Boundary& surface, const NodeMotion& moving, double radius)
    : surface_(surface), moving_(moving) {
  const double spacing = moving.body().spacing();
  reach_ = std::max(2 * radius, 2 * spacing);
  depth_ = 0.25 * spacing;
  near_.reserve(surface.most_facets());
  facets_.reserve(std::min(most_facets, surface.most_facets()));
}

void StickSurface::look(const Stick& stick, double t) noexcept {
  const double around = reach_ + stick.radius + 2 * StickSearch::margin;
  const bool opened = surface_.changed_near(stick.axis_point(0.5), 0.5 * stick.D.norm() + around,
                                            searched_revision_, moving_);
  searched_revision_ = surface_.revision();
  if (!search_.due(stick, t) && !opened) return;
  facets_around(stick, around, surface_, moving_, near_);
}

/// Does a mass at its corners move?
bool StickSurface::gives(std::uint32_t facet) const noexcept {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Bearers by = surface_.bearers(facet, corner);
    for (std::uint32_t b = 0; b < by.n; ++b)
      if (moving_.body().inverse_mass[static_cast<std::size_t>(by.node[b])] > 0) return true;
  }
  return false;
}

/// Facets beside which the stick is less than R, on the side of the one that it is nearest to. Whether it is on a facet's outer
/// side is seen where the facet is now: at rest it may lie far above a stick that is pressed in.
void StickSurface::collect(const Stick& stick, bool at_rest) noexcept {
  facets_.clear();
  double least = std::numeric_limits<double>::infinity();
  Vec3 side = Vec3::Zero();
  for (const std::uint32_t id : near_) {
    if (facets_.size() == facets_.capacity()) break;
    if (!surface_.exists(id)) continue;
    const auto now = surface_.centroid_and_area(id, moving_);
    Facet facet;
    facet.rest = surface_.settled_centroid(id);
    facet.centre = at_rest ? facet.rest : now.centroid;
    const Vec3 area = at_rest ? surface_.settled_area(id) : now.area;
    facet.area = area.norm();
    if (!(facet.area > 0)) continue;
    facet.normal = area / facet.area;
    const Vec3 apart_now = stick.axis_point(stick.nearest(now.centroid)) - now.centroid;
    if (now.area.dot(apart_now) < -stick.radius * now.area.norm()) continue;  // beyond the other side
    facet.along = stick.nearest(facet.centre);
    const Vec3 apart = stick.axis_point(facet.along) - facet.centre;
    const double height = facet.normal.dot(apart);
    facet.gap = height - stick.radius;
    facet.lateral = std::max(0.0, apart.squaredNorm() - height * height) / (reach_ * reach_);
    if (facet.lateral >= 1) continue;
    facet.held = !gives(id);
    if (apart_now.squaredNorm() < least) least = apart_now.squaredNorm(), side = facet.normal;
    facets_.push_back(facet);
  }
  std::erase_if(facets_, [&](const Facet& facet) { return facet.normal.dot(side) < side_limit; });
}

StickPlane StickSurface::plane(const Stick& stick, bool at_rest) noexcept {
  StickPlane plane;
  collect(stick, at_rest);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets_) lowest = std::min(lowest, facet.gap);
  Vec3 normal = Vec3::Zero(), sunk = Vec3::Zero();
  double square = 0;
  for (const Facet& facet : facets_) {
    const double l = 1 - facet.lateral, g = 1 - (facet.gap - lowest) / depth_;
    if (g <= 0) continue;
    const double w = facet.area * l * l * g * g;
    plane.area += w;
    plane.gap += w * facet.gap;
    plane.along += w * facet.along;
    square += w * facet.along * facet.along;
    if (facet.held) plane.held += w;
    normal += w * facet.normal;
    if (!at_rest) sunk += w * (facet.rest - facet.centre);
  }
  if (!(plane.area > 0) || normal.norm() < 0.1 * plane.area) return {};
  plane.found = true;
  plane.normal = normal.normalized();
  plane.gap /= plane.area;
  plane.along /= plane.area;
  plane.spread = std::sqrt(std::max(0.0, square / plane.area - plane.along * plane.along));
  plane.held /= plane.area;
  plane.sunk = sunk.dot(plane.normal) / plane.area;
  return plane;
}

}  // namespace palpate::physics
