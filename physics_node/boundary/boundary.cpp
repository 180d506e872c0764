#include "physics_node/boundary/boundary.h"

#include <algorithm>

#include "common/error/error.h"

namespace palpate::physics {
namespace {

constexpr double shut_gap = 0.3;  // of a cell. Why: a tip that finds less of a gap does not go into it

/// With every element, whatever is broken by now.
Surface surface_as_loaded(const Body& body) {
  LiveElements all(body);
  all.copy(body, body.adjacency());
  return make_surface(body, all, std::nullopt, 0);
}

}  // namespace

Boundary::Boundary(const BodyModel& moving, double bucket_size, bool follows)
    : body_(moving), surface_(surface_as_loaded(moving.body())), bucket_size_(bucket_size) {
  Vec3 high = Vec3::Zero();
  if (!surface_.rest.empty()) low_ = high = surface_.rest.front();
  for (const Vec3& p : surface_.rest) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
  // No more buckets than this many each way: a tiny bucket in a huge body would cost memory for nothing.
  bucket_size_ = std::max(bucket_size_, (high - low_).maxCoeff() / 200);
  n_buckets_ = ((high - low_) / bucket_size_).array().floor().cast<int>() + 1;

  std::vector<std::pair<std::size_t, std::uint32_t>> rigid;
  for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
    const auto& corners = surface_.facets[f];
    const bool moves = moving.parts() == nullptr && std::any_of(corners.begin(), corners.end(), [&](auto c) {
                         return c < surface_.n_moving();
                       });
    if (moves) {
      moving_facets_.push_back(f);
    } else {
      rigid.emplace_back(bucket_of(centroid(f, moving)), f);
    }
  }
  std::sort(rigid.begin(), rigid.end());
  bucket_start_.assign(static_cast<std::size_t>(n_buckets_.prod()) + 1, 0);
  for (const auto& [bucket, facet] : rigid) {
    ++bucket_start_[bucket + 1];
    bucket_facets_.push_back(facet);
  }
  for (std::size_t b = 1; b < bucket_start_.size(); ++b) bucket_start_[b] += bucket_start_[b - 1];
  for (std::uint32_t v = 0; v < surface_.n_moving(); ++v) sag_.push_back(displacement(v, moving));
  if (std::ranges::all_of(sag_, [](const Vec3& u) { return u.isZero(0); })) sag_.clear();
  if (follows && may_come_apart(moving.body())) prepare_to_follow();
}

void Boundary::prepare_to_follow() {
  PALPATE_CHECK(std::is_sorted(surface_.site.begin(), surface_.site.end()),
                "facets in the order of their sites");
  sites_ = make_site_facets(body_);
  if (!surface_.bearers.empty()) skin_ = std::make_unique<LiveSkin>(body_, surface_);
  const std::size_t n = sites_->n_sites();
  gone_.resize(surface_.facets.size());
  first_.resize(n);
  waits_.resize(n);
  queue_.resize(n);
  // Why: a body that is half crumbs has about as many open facets as masses. And a tetrahedron has four.
  const std::size_t both_sides = 2 * 4 * body_.body().most_copies();
  open_.resize(body_.body().mesh ? 4 * n : body_.body().nodes().size() + 4096 + both_sides);
  restart();
}

std::size_t Boundary::bucket_of(const Vec3& p) const {
  const Vec3i at = ((p - low_) / bucket_size_).array().floor().cast<int>().max(0).min(n_buckets_.array() - 1);
  return static_cast<std::size_t>(at.x() + n_buckets_.x() * (at.y() + n_buckets_.y() * at.z()));
}

void Boundary::facets_near(const Vec3& p, double radius, const NodeMotion& moving,
                           std::vector<std::uint32_t>& out) const {
  const double around = radius + body_.body().spacing();
  const auto take = [&](std::uint32_t facet) {
    if (!surface_.bearers.empty() && (nearly_centroid(facet, moving) - p).squaredNorm() > around * around)
      return;
    if (exists(facet) && (centroid(facet, moving) - p).squaredNorm() <= radius * radius &&
        !is_shut(facet, moving))
      out.push_back(facet);
  };
  for (const std::uint32_t facet : moving_facets_) take(facet);
  const auto n_loaded = static_cast<std::uint32_t>(surface_.facets.size());
  for (std::uint32_t n = 0; n < n_used_; ++n) take(n_loaded + n);
  if (bucket_facets_.empty()) return;
  const Vec3 reach = Vec3::Constant(radius + (moving.parts() != nullptr ? moving.parts()->most_moved : 0));
  const Eigen::Array3i lo = ((p - reach - low_) / bucket_size_).array().floor().cast<int>().max(0);
  const Eigen::Array3i hi =
      ((p + reach - low_) / bucket_size_).array().floor().cast<int>().min(n_buckets_.array() - 1);
  for (int z = lo.z(); z <= hi.z(); ++z)
    for (int y = lo.y(); y <= hi.y(); ++y)
      for (int x = lo.x(); x <= hi.x(); ++x) {
        const auto b = static_cast<std::size_t>(x + n_buckets_.x() * (y + n_buckets_.y() * z));
        for (std::uint32_t n = bucket_start_[b]; n < bucket_start_[b + 1]; ++n) take(bucket_facets_[n]);
      }
}

bool Boundary::exists(std::uint32_t facet) const noexcept {
  return is_loaded(facet) ? gone_.empty() || gone_[facet] == 0 : open_at(facet).open;
}

bool Boundary::is_triangle(std::uint32_t facet) const noexcept {
  if (!is_loaded(facet)) return open_at(facet).masses[2] == open_at(facet).masses[3];
  return surface_.facets[facet][2] == surface_.facets[facet][3];
}

Index Boundary::mass(std::uint32_t facet, std::size_t corner) const noexcept {
  if (!is_loaded(facet)) return open_at(facet).masses[corner];
  const std::uint32_t vertex = surface_.facets[facet][corner];
  return vertex < surface_.n_moving() ? surface_.cell[vertex] : -1;
}

bool Boundary::has_mass(std::uint32_t facet) const noexcept {
  return mass(facet, 0) >= 0 || mass(facet, 1) >= 0 || mass(facet, 2) >= 0 || mass(facet, 3) >= 0;
}

std::optional<std::uint32_t> Boundary::vertex(std::uint32_t facet, std::size_t corner) const noexcept {
  if (is_loaded(facet)) return surface_.facets[facet][corner];
  return skin_ ? skin_->vertex_of(body_.body().origin(open_at(facet).masses[corner])) : std::nullopt;
}

/// By more than the vertex's own mass; null: by that alone.
const Bearers* Boundary::carried(std::uint32_t vertex) const noexcept {
  if (surface_.bearers.empty()) return nullptr;
  return skin_ ? &skin_->bearers(vertex) : &surface_.bearers[vertex];
}

std::int64_t Boundary::corner(std::uint32_t facet, std::size_t corner) const noexcept {
  if (lip(facet, corner) != nullptr)
    return std::int64_t{body_.body().capacity()} + static_cast<std::int64_t>(surface_.n_vertices()) +
           mass(facet, corner);
  const auto at = vertex(facet, corner);
  if (!at || (*at < surface_.n_moving() && surface_.bearers.empty())) return mass(facet, corner);
  return std::int64_t{body_.body().capacity()} + *at;
}

Bearers Boundary::bearers(std::uint32_t facet, std::size_t corner) const noexcept {
  if (const LiveSkin::Lip* of = lip(facet, corner)) return of->by;
  const auto at = vertex(facet, corner);
  if (at && *at >= surface_.n_moving()) return {};
  const Bearers* by = at ? carried(*at) : nullptr;
  return by != nullptr ? *by : Bearers::alone(mass(facet, corner));
}

Vec3 Boundary::displacement(std::uint32_t vertex, const NodeMotion& moving) const noexcept {
  const Bearers* by = carried(vertex);
  if (by == nullptr) return moving.displacement(surface_.cell[vertex]);
  return by->displacement(moving);
}

Vec3 Boundary::place(std::uint32_t vertex, const NodeMotion& moving) const noexcept {
  const Vec3& rest = surface_.rest[vertex];
  return vertex < surface_.n_moving() ? Vec3(rest + displacement(vertex, moving)) : rest;
}

Vec3 Boundary::position(std::uint32_t facet, std::size_t corner, const NodeMotion& moving) const noexcept {
  if (const LiveSkin::Lip* of = lip(facet, corner)) return of->position(moving);
  const auto at = vertex(facet, corner);
  return at ? place(*at, moving) : moving.position(open_at(facet).masses[corner]);
}

/// Of what opened.
Vec3 Boundary::now(Index mass, const NodeMotion& moving) const noexcept {
  const LiveSkin::Lip* lip = skin_ ? skin_->lip(mass) : nullptr;
  return lip != nullptr ? lip->position(moving) : moving.position(mass);
}

bool Boundary::is_shut(std::uint32_t facet, const NodeMotion& moving) const noexcept {
  if (is_loaded(facet) || open_at(facet).across[0] < 0) return false;
  const OpenFacet& open = open_at(facet);
  Vec3 apart = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c) apart += now(open.across[c], moving) - now(open.masses[c], moving);
  const Vec3 area = centroid_and_area(facet, moving).area;
  return apart.dot(area) < 4 * shut_gap * body_.body().spacing() * area.norm();
}

Vec3 Boundary::rest(std::uint32_t facet, std::size_t corner) const noexcept {
  if (const LiveSkin::Lip* of = lip(facet, corner)) return of->rest;
  const auto at = vertex(facet, corner);
  return at ? surface_.rest[*at] : body_.body().rest_position(open_at(facet).masses[corner]);
}

Vec3 Boundary::centroid(std::uint32_t facet, const NodeMotion& moving) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < 4; ++n) sum += position(facet, n, moving);
  return sum / 4;
}

/// Of a smooth skin by the masses at its corners, which is off by what tissue strains in half a cell: to leave out
/// what is far.
Vec3 Boundary::nearly_centroid(std::uint32_t facet, const NodeMotion& moving) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < 4; ++n) {
    sum += rest(facet, n);
    if (const Index own = mass(facet, n); own >= 0) sum += moving.displacement(own);
  }
  return sum / 4;
}

Vec3 Boundary::rest_area(std::uint32_t facet) const noexcept {
  return 0.5 * (rest(facet, 2) - rest(facet, 0)).cross(rest(facet, 3) - rest(facet, 1));
}

Vec3 Boundary::settled(std::uint32_t facet, std::size_t corner) const noexcept {
  const Vec3 p = rest(facet, corner);
  if (sag_.empty() || !is_loaded(facet)) return p;
  const std::uint32_t vertex = surface_.facets[facet][corner];
  return vertex < sag_.size() ? Vec3(p + sag_[vertex]) : p;
}

Vec3 Boundary::settled_centroid(std::uint32_t facet) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < 4; ++n) sum += settled(facet, n);
  return sum / 4;
}

Vec3 Boundary::settled_area(std::uint32_t facet) const noexcept {
  return 0.5 * (settled(facet, 2) - settled(facet, 0)).cross(settled(facet, 3) - settled(facet, 1));
}

Boundary::CentroidAndArea Boundary::centroid_and_area(std::uint32_t facet,
                                                      const NodeMotion& moving) const noexcept {
  const Vec3 p0 = position(facet, 0, moving);
  const Vec3 p1 = position(facet, 1, moving);
  const Vec3 p2 = position(facet, 2, moving);
  const Vec3 p3 = position(facet, 3, moving);
  return {0.25 * (p0 + p1 + p2 + p3), 0.5 * (p2 - p0).cross(p3 - p1)};
}

}  // namespace palpate::physics
