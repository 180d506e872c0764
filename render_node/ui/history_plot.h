#pragma once
// The live plot: force against the last ten seconds, hand and tissue as two lines.

#include "render_node/model/view_model.h"

namespace palpate::render {

/// Lays the plot out in the current ImGui window, over its free width. @param height [px]
void force_plot(const ToolView& tool, float height);

/// A round number not below `value` for the top of an axis; at least 0.1.
double axis_top(double value);

}  // namespace palpate::render
