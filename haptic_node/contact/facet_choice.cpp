#include "haptic_node/contact/facet_choice.h"

#include <cmath>
#include <limits>

#include "common/message/vec3.h"
#include "haptic_node/contact/facet_geometry.h"

namespace palpate::haptic {
namespace {

constexpr double tie = 1e-6;              // [m]
constexpr double hysteresis = 5e-5;       // [m]
constexpr double other_side_cost = 5e-4;  // [m]

}  // namespace

bool same_side(const Vec3& a, const Vec3& b) noexcept { return a.dot(b) > same_side_cosine; }

std::uint32_t nearest_facet(const ContactPatch& patch, const Vec3& x) noexcept {
  std::uint32_t best = no_facet;
  double best_distance = std::numeric_limits<double>::infinity();
  double best_height = 0;
  for (std::uint32_t i = 0; i < patch.n_facets; ++i) {
    const PatchFacet& facet = patch.facets[i];
    const double distance = locate(x, facet).distance;
    const double height = std::abs(vec(facet.normal).dot(x - vec(facet.corners[0])));
    const bool nearer = distance < best_distance - tie;
    const bool tied = distance < best_distance + tie && height > best_height;
    if (!nearer && !tied) continue;
    best = i;
    best_distance = distance;
    best_height = height;
  }
  return best;
}

std::uint32_t facet_under_proxy(const ContactPatch& patch, const Vec3& proxy, std::uint32_t current,
                                const Vec3& normal) noexcept {
  if (current < patch.n_facets && locate(proxy, patch.facets[current]).lateral <= hysteresis) return current;
  std::uint32_t best = no_facet;
  double best_cost = std::numeric_limits<double>::infinity();
  double best_height = 0;
  for (std::uint32_t i = 0; i < patch.n_facets; ++i) {
    const PatchFacet& facet = patch.facets[i];
    const double extra = same_side(vec(facet.normal), normal) ? 0.0 : other_side_cost;
    const FacetPosition position = locate(proxy, facet);
    const double cost = position.lateral + 0.2 * position.distance + extra;
    const double height = vec(facet.normal).dot(proxy - vec(facet.corners[0]));
    const bool nearer = cost < best_cost - tie;
    const bool tied = cost < best_cost + tie && height > best_height;
    if (!nearer && !tied) continue;
    best = i;
    best_cost = cost;
    best_height = height;
  }
  return best;
}

std::uint32_t facet_alike(const ContactPatch& patch, const Vec3& proxy, const Vec3& normal,
                          double most_lateral) noexcept {
  std::uint32_t best = no_facet;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < patch.n_facets; ++i) {
    if (!same_side(vec(patch.facets[i].normal), normal)) continue;
    const FacetPosition position = locate(proxy, patch.facets[i]);
    if (position.lateral > most_lateral || position.distance >= best_distance) continue;
    best = i;
    best_distance = position.distance;
  }
  return best;
}

}  // namespace palpate::haptic
