#pragma once
// Where a point stands with respect to one facet of a patch.

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate::haptic {

/// The point of the triangle (a, b, c), edges and corners included, that is nearest to p.
/// Source: Ericson 2005, Real-Time Collision Detection, 5.1.5 (regions of barycentric coordinates).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

struct FacetPosition {
  double distance = 0;  // from p to the triangle [m]
  double lateral = 0;   // the part of it within the triangle's own plane: 0 above or below the triangle [m]
  double gap = 0;       // of p above the plane at zero contact force; below 0: inside [m]
};

FacetPosition locate(const Vec3& p, const PatchFacet& facet) noexcept;

/// n.(p - point): above 0 outside the tissue [m]
double facet_gap(const Vec3& p, const PatchFacet& facet) noexcept;

}  // namespace palpate::haptic
