#include "physics_node/contact/tool_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/hash.h"
#include "common/message/vec3.h"

namespace palpate::physics {
namespace {

constexpr double search_period = 0.020;  // [s] after which tissue may have come near by itself
constexpr double facing_limit = -0.2;    // cosine below which a facet belongs to the other side
constexpr std::size_t room = 16384;      // facets kept at the most, the nearest

/// One entry per mass, in storage order.
void merge_equal_masses(std::vector<MassShare>& shares) noexcept {
  std::sort(shares.begin(), shares.end(), [](const MassShare& a, const MassShare& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.share < b.share;
  });
  std::size_t n = 0;
  for (const MassShare& share : shares) {
    if (n > 0 && shares[n - 1].cell == share.cell) {
      shares[n - 1].share += share.share;
    } else {
      shares[n++] = share;
    }
  }
  shares.resize(n, MassShare{});
}

}  // namespace

ToolContact::ToolContact(const Boundary& surface, const NodeMotion& moving, double radius, double farther)
    : surface_(surface), moving_(moving) {
  const double coarse = moving.body().spacing();
  radius_ = std::max(2 * radius, 2 * coarse);
  reach_ = radius_ + farther + search_margin;
  found_.reserve(8 * room);
  near_.reserve(room);
  corners_.reserve(4 * room);
  order_.reserve(4 * room);
  facets_.reserve(room);
  shares_.reserve(32 * room);
}

void ToolContact::look(const Vec3& p, double t) noexcept {
  const bool moved = (p - searched_at_).norm() > 0.5 * search_margin;
  const bool opened =
      surface_.changed_near(p, reach_ + 2 * search_margin, searched_revision_, moving_) ||
      std::any_of(near_.begin(), near_.end(), [this](const Near& near) { return !surface_.exists(near.id); });
  searched_revision_ = surface_.revision();
  if (moved || opened || t - searched_when_ >= search_period || t < searched_when_) {
    search(p);
    searched_at_ = p;
    searched_when_ = t;
  }
  for (Corner& corner : corners_) corner.place = surface_.position(corner.facet, corner.of_facet, moving_);
  facets_.clear();
  for (const Near& near : near_) {
    const Vec3 &p0 = corners_[near.corner[0]].place, &p1 = corners_[near.corner[1]].place,
               &p2 = corners_[near.corner[2]].place, &p3 = corners_[near.corner[3]].place;
    const Vec3 centroid = 0.25 * (p0 + p1 + p2 + p3);
    if ((centroid - p).squaredNorm() > reach_ * reach_) continue;
    const Vec3 area = 0.5 * (p2 - p0).cross(p3 - p1);
    const double size = area.norm();
    if (size > 0)
      facets_.push_back({near.id, centroid, area / size, near.rest, near.rest_normal, size, near.corner});
  }
}

/// Facets around p, each corner of theirs once.
void ToolContact::search(const Vec3& p) noexcept {
  found_.clear();
  surface_.facets_near(p, reach_ + search_margin, moving_, found_);
  keep_nearest(p);
  near_.clear();
  order_.clear();
  corners_.clear();
  for (const std::uint32_t id : found_) {
    for (std::uint32_t c = 0; c < 4; ++c)
      order_.emplace_back(surface_.corner(id, c), static_cast<std::uint32_t>(4 * near_.size()) + c);
    near_.push_back({id, {}, surface_.settled_centroid(id), surface_.settled_area(id).normalized()});
  }
  std::sort(order_.begin(), order_.end());
  for (const auto& [number, at] : order_) {
    if (corners_.empty() || corners_.back().number != number)
      corners_.push_back({number, near_[at / 4].id, at % 4});
    near_[at / 4].corner[at % 4] = static_cast<std::uint32_t>(corners_.size() - 1);
  }
}

void ToolContact::keep_nearest(const Vec3& p) noexcept {
  if (found_.size() <= room) return;
  const auto distance = [&](std::uint32_t id) {
    return (surface_.centroid_and_area(id, moving_).centroid - p).squaredNorm();
  };
  std::nth_element(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(room), found_.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double da = distance(a);
                     const double db = distance(b);
                     return da != db ? da < db : a < b;
                   });
  found_.resize(room);
}

const ToolContact::Facet* ToolContact::nearest(const Vec3& p) const noexcept {
  const Facet* best = nullptr;
  double least = 0;
  for (const Facet& facet : facets_) {
    if (facet.looks <= 0) continue;
    const double d = (facet.centroid - p).squaredNorm();
    if (best == nullptr || d < least) best = &facet, least = d;
  }
  return best;
}

double ToolContact::nearest_distance(const Vec3& p) const noexcept {
  const Facet* facet = nearest(p);
  return facet == nullptr ? std::numeric_limits<double>::infinity() : (facet->centroid - p).norm();
}

ToolContact::Nearest ToolContact::nearest_to(const RigidShape& shape, const Vec3& origin,
                                             const Eigen::Matrix3d& axes) noexcept {
  Nearest best{std::numeric_limits<double>::infinity()};
  for (Facet& facet : facets_) {
    const RigidShape::Distance d = shape.distance(axes.transpose() * (facet.centroid - origin));
    const Vec3 out = axes * d.outward;
    facet.looks = std::max(0.0, -facet.normal.dot(out));
    if (d.distance >= best.distance || facet.looks <= 0) continue;
    best = {d.distance, facet.centroid, facet.centroid - d.distance * out};
  }
  return best;
}

void ToolContact::facets_within(const Vec3& p, double radius,
                                std::vector<std::uint32_t>& out) const noexcept {
  for (const Facet& facet : facets_)
    if ((facet.centroid - p).squaredNorm() <= radius * radius && out.size() < out.capacity())
      out.push_back(facet.id);
}

double ToolContact::weight(const Facet& facet, const Vec3& q, const Vec3& facing) const noexcept {
  const double r2 = (facet.centroid - q).squaredNorm() / (radius_ * radius_);
  if (r2 >= 1) return 0;
  if (facet.normal.dot(facing) < facing_limit) return 0;
  return facet.area * (1 - r2) * (1 - r2);
}

LocalPlane ToolContact::plane_at(const Vec3& q, const Vec3& facing) const noexcept {
  LocalPlane plane;
  double sum = 0, around = 0;
  Vec3 all_ways = Vec3::Zero();
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  Vec3 rest = Vec3::Zero();
  Vec3 rest_normal = Vec3::Zero();
  for (const Facet& facet : facets_) {
    const double near = weight(facet, q, facing), w = facet.looks * near;
    if (near <= 0) continue;
    around += near;
    all_ways += near * facet.rest_normal;
    sum += w;
    point += w * facet.centroid;
    normal += w * facet.normal;
    rest += w * facet.rest;
    rest_normal += w * facet.rest_normal;
  }
  if (sum <= 0 || normal.norm() < 0.1 * sum) return plane;
  plane.found = true;
  plane.point = point / sum;
  plane.normal = normal.normalized();
  plane.rest = rest / sum;
  plane.flat = all_ways.norm() / around;
  if (rest_normal.norm() >= 0.1 * sum) plane.rest_normal = rest_normal.normalized();
  return plane;
}

LocalPlane ToolContact::plane_under(const Vec3& p) const noexcept {
  const Facet* start = nearest(p);
  if (start == nullptr) return {};
  // First the side that the neighbourhood faces: a single voxel facet may be the riser of a step.
  LocalPlane plane = plane_at(start->centroid, start->normal);
  for (int n = 0; n < 3 && plane.found; ++n) {
    const Vec3 q = p - plane.normal.dot(p - plane.point) * plane.normal;
    const LocalPlane next = plane_at(q, plane.normal);
    if (!next.found) break;
    plane = next;
  }
  return plane;
}

void ToolContact::find_shares(const Vec3& q) noexcept {
  shares_.clear();
  const LocalPlane plane = plane_under(q);
  if (!plane.found) return;
  const Vec3 foot = q - plane.normal.dot(q - plane.point) * plane.normal;
  double sum = 0;
  for (const Facet& facet : facets_) sum += facet.looks * weight(facet, foot, plane.normal);
  if (sum <= 0) return;
  // By corners first: several facets have each, and several corners each mass.
  for (Corner& corner : corners_) corner.weight = 0;
  for (const Facet& facet : facets_) {
    const double w = facet.looks * weight(facet, foot, plane.normal);
    if (w <= 0) continue;
    for (const std::uint32_t corner : facet.corner) corners_[corner].weight += w / (4 * sum);
  }
  for (const Corner& corner : corners_) {
    if (corner.weight <= 0) continue;
    const Bearers by = surface_.bearers(corner.facet, corner.of_facet);
    for (std::uint32_t b = 0; b < by.n && shares_.size() < shares_.capacity(); ++b)
      shares_.push_back({by.node[b], by.weight[b] * corner.weight});
  }
  merge_equal_masses(shares_);
}

std::uint32_t ToolContact::write_facets(const Vec3& p, std::uint32_t body, PatchFacet* out,
                                        std::uint32_t n_room, bool at_rest) noexcept {
  const auto closer = [&](const Facet& a, const Facet& b) {
    const double da = (a.centroid - p).squaredNorm();
    const double db = (b.centroid - p).squaredNorm();
    return da != db ? da < db : a.id < b.id;
  };
  const std::size_t n = std::min<std::size_t>(facets_.size(), n_room / 2);
  std::partial_sort(facets_.begin(), facets_.begin() + static_cast<std::ptrdiff_t>(n), facets_.end(), closer);
  std::uint32_t written = 0;
  contact_set_ = hash_seed;
  const LocalPlane under = plane_under(p);
  for (std::size_t f = 0; f < n && under.found; ++f) {
    const Facet& facet = facets_[f];
    const LocalPlane plane = plane_at(facet.centroid, under.normal);
    if (!plane.found || facet.normal.dot(under.normal) < facing_limit) continue;
    if (at_rest && plane.rest_normal.isZero()) continue;
    for (std::size_t half = 0; half < 2; ++half) {
      if (half == 1 && surface_.is_triangle(facet.id)) continue;
      PatchFacet& patch = out[written++];
      patch = {};
      const std::array<std::size_t, 3> of =
          half == 0 ? std::array<std::size_t, 3>{0, 1, 2} : std::array<std::size_t, 3>{0, 2, 3};
      for (std::size_t c = 0; c < 3; ++c)
        patch.corners[c] = array(surface_.position(facet.id, of[c], moving_));
      patch.point = array(at_rest ? plane.rest : plane.point);
      patch.normal = array(at_rest ? plane.rest_normal : plane.normal);
      patch.body = body;
    }
    contact_set_ = hash_bytes(&facet.id, sizeof(facet.id), contact_set_);
  }
  if (written == 0) contact_set_ = 0;
  return written;
}

}  // namespace palpate::physics
