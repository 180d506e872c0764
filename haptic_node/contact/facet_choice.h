#pragma once
// Which facet of a patch the hand, or the proxy that stands for it on the surface, belongs to.

#include <cstdint>

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate::haptic {

inline constexpr std::uint32_t no_facet = ~0u;

/// Normals that differ by more than this belong to different sides of an edge: cos 30 degrees.
inline constexpr double same_side_cosine = 0.8660254037844386;

bool same_side(const Vec3& a, const Vec3& b) noexcept;

/// For a hand in free space: the nearest facet; of several that share the nearest edge or corner, the one whose plane
/// is farthest, so that beside a convex edge the facet that the hand is outside of decides.
/// @return no_facet for an empty patch
std::uint32_t nearest_facet(const ContactPatch& patch, const Vec3& x) noexcept;

/// For a proxy that rests on the surface: stays on facet `current` as long as the proxy is over it, then moves to the
/// nearest, facets on the same side first.
/// @param current  facet of this patch, or no_facet
/// @param normal   of the plane that carries the proxy
std::uint32_t facet_under_proxy(const ContactPatch& patch, const Vec3& proxy, std::uint32_t current,
                                const Vec3& normal) noexcept;

/// Nearest facet with a normal within 30 degrees of `normal` and the proxy over it, or no_facet.
std::uint32_t facet_alike(const ContactPatch& patch, const Vec3& proxy, const Vec3& normal,
                          double most_lateral) noexcept;

}  // namespace palpate::haptic
