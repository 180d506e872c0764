#pragma once
// The render node's life: takes messages, draws them into a window or into OUT/frames/frame_00001.png and so on, and
// leaves OUT/parts/render.json.

#include "common/process/node_main.h"
#include "common/scene/scene_fwd.h"

namespace palpate::render {

/// Runs until the time given is over, a signal or the command stop comes, or the window is closed (which tells the
/// others to stop too).
/// @return exit code @throws InputError: nothing to draw with, or nowhere to write to
int run_render(const NodeOptions& options, const Scene& scene);

}  // namespace palpate::render
