#pragma once
// What helps to read the picture: a scale bar in its lower right corner and the axes of the world in the lower left of
// what the column leaves free.

#include "render_node/view/camera.h"
#include "render_node/view/colour_scale.h"

namespace palpate::render {

/// What the colours of tissue say, in the lower right corner above the scale bar.
void lay_out_legend(const ColourScale& colours, float scale);

/// Lays both out in the current ImGui frame, beneath its windows.
/// @param left  covered by the column [px]  @param scale  of all lengths, 1 at 720 px
void lay_out_measures(const Camera& camera, float left, float scale);

}  // namespace palpate::render
