#pragma once
// What a person before the picture should know now, in words: why there is no force, that the hand's path is over, what the
// nodes remark.

#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/model/view_model.h"
#include "render_node/view/tool_pointer.h"

namespace palpate::render {

/// Lines for the middle of the picture; empty: nothing hinders. One a tool at most.
/// @param paused   by this window
/// @param pointer  the tool that the mouse leads, if any
std::vector<std::string> hindrances(const Scene& scene, const ViewModel& model, bool paused,
                                    const ToolPointer* pointer);

}  // namespace palpate::render
