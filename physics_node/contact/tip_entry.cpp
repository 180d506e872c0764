#include "physics_node/contact/tip_entry.h"

#include <cmath>

namespace palpate::physics {
namespace {

constexpr double looks_beyond =
    2;  // spacings: how far a facet's middle is from its corners, and what tissue moves in a frame
constexpr double between_corners = 1e-6;  // Why: what rounding puts between two triangles is in one of them

struct Hit {
  double share = 2;  // of the step; above 1: none
  Vec3 weights = Vec3::Zero();
  Vec3 out = Vec3::UnitZ();
};

/// @param a, b  corners at both ends of the step
Hit pass(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) noexcept {
  const auto height = [](const Vec3& at, const std::array<Vec3, 3>& of) {
    return (at - of[0]).dot((of[1] - of[0]).cross(of[2] - of[0]));
  };
  const double h0 = height(p, a), h1 = height(q, b);
  if (!(h0 >= 0 && h1 < 0)) return {};
  const double share = h0 / (h0 - h1);
  std::array<Vec3, 3> c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = a[i] + share * (b[i] - a[i]);
  const Vec3 at = p + share * (q - p), normal = (c[1] - c[0]).cross(c[2] - c[0]);
  const double size = normal.squaredNorm();
  if (!(size > 0)) return {};
  Vec3 weights;
  for (std::size_t i = 0; i < 3; ++i)
    weights[static_cast<Eigen::Index>(i)] =
        normal.dot((c[(i + 1) % 3] - at).cross(c[(i + 2) % 3] - at)) / size;
  if (weights.minCoeff() < -between_corners) return {};
  return {share, weights, normal / std::sqrt(size)};
}

}  // namespace

TipEntry::TipEntry(const TouchableBody& body) : body_(body), contact_(*body.surface, *body.moving, 0) {
  near_.reserve(most_facets);
  before_.reserve(most_facets);
}

void TipEntry::look(const Vec3& tip, double way, double t) noexcept {
  contact_.look(tip, t);
  near_.clear();
  contact_.facets_within(tip, way + looks_beyond * body_.moving->body().spacing(), near_);
  before_.resize(near_.size());
}

TipEntry::Corners TipEntry::places(std::uint32_t facet) const noexcept {
  Corners at;
  for (std::size_t c = 0; c < 4; ++c) at[c] = body_.surface->position(facet, c, *body_.moving);
  return at;
}

void TipEntry::begin_step() noexcept {
  for (std::size_t n = 0; n < near_.size(); ++n) before_[n] = places(near_[n]);
}

std::optional<TipEntry::Through> TipEntry::come_through(const Vec3& before, const Vec3& now) const noexcept {
  constexpr std::array<std::array<std::size_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
  double first = 2;
  std::optional<Through> through;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    const std::uint32_t facet = near_[n];
    if (!body_.surface->exists(facet)) continue;
    const Corners at = places(facet);
    for (const auto& k : triangles) {
      const auto of = [&k](const Corners& all) {
        return std::array<Vec3, 3>{all[k[0]], all[k[1]], all[k[2]]};
      };
      const Hit hit = pass(before, now, of(before_[n]), of(at));
      if (hit.share > 1 || hit.share >= first) continue;
      first = hit.share;
      through = Through{.out = hit.out, .rigid = !body_.surface->has_mass(facet)};
      for (std::size_t i = 0; i < 3; ++i)
        through->rest += hit.weights[static_cast<Eigen::Index>(i)] * body_.surface->rest(facet, k[i]);
    }
  }
  return through;
}

}  // namespace palpate::physics
