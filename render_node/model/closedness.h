#pragma once
// Does a surface enclose its body, seen from outside everywhere?

#include "render_node/model/surface.h"

namespace palpate::render {

/// True if every edge has a facet on either side, the area vectors of the facets cancel and the volume inside is
/// positive: what every closed surface with outward corners has, and no plain sheet, inside-out surface or one that a
/// cut has opened, though its lips still lie on each other. Cost: a pass over the facets.
bool is_closed(const Surface& surface);

}  // namespace palpate::render
