#pragma once
// What a body has lost that no facet shows: elements that bound no triangle of live elements, and masses without any.
// They stay visible and keep their mass. Source: EQUATIONS C-8.

#include "physics_node/boundary/surface.h"

namespace palpate::physics {

/// A live element in no triangle of live elements, or, with both ends the same, a mass that has lost all its elements.
using LoosePart = std::array<Index, 2>;  // storage cells

/// In storage order. Cost: a few operations on bits for each element.
std::vector<LoosePart> loose_parts(const Body& body, const LiveElements& live);

/// Adds them to a surface as degenerate facets: an element repeats its second corner, a mass its only one.
/// @param threshold,plain_rgba  as the surface was made with; what lies in cells not shown is left out
void add_loose_parts(const Body& body, const LiveElements& live, std::optional<double> threshold,
                     std::uint32_t plain_rgba, Surface& surface);

/// Does a facet stand for an element or a mass, without an area?
inline bool is_loose(const std::array<std::uint32_t, 4>& facet) { return facet[1] == facet[3]; }
std::size_t count_loose(const Surface& surface);

}  // namespace palpate::physics
