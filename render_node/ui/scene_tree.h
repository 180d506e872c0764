#pragma once
// The list of bodies and tools with an eye before each: what is shown.

#include "common/scene/scene_fwd.h"
#include "render_node/view/hidden.h"

namespace palpate::render {

/// Lays it out in the current ImGui window; longer lists than eight scroll. A click on an eye hides or shows.
void lay_out_scene_tree(const Scene& scene, Hidden& hidden);

}  // namespace palpate::render
