#pragma once
// Does a surface enclose its body, seen from outside everywhere?

#include "render_node/model/surface.h"

namespace palpate::render {

/// True if the area vectors of the facets cancel and the volume inside is positive: what every closed surface with
/// outward corners has, and no plain sheet or inside-out surface. A necessary sign, cheap to look at.
bool is_closed(const Surface& surface);

}  // namespace palpate::render
