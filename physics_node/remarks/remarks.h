#pragma once
// What is legal in a scene and yet hardly meant: one line each, with the place, the numbers and what would be right. For a
// person's eye only; nothing here changes what is computed.

#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/world.h"

namespace palpate::physics {

using Remarks = std::vector<std::string>;
using Bodies = std::vector<const BodyModel*>;  // as loaded, one for each of the scene

/// All of the below about a world that has just been loaded, in the order of a scene file.
/// Cost: some passes over masses and surfaces; a second for a head of 256 x 256 x 77 cells.
Remarks remarks_about(const World& world);

// number_remarks.cpp: figures that another unit would explain
Remarks number_remarks(const Scene& scene, const Bodies& bodies, int steps_a_frame);
// body_remarks.cpp: what holds bodies, and what they begin in
Remarks body_remarks(const Scene& scene, const Bodies& bodies);
// tool_remarks.cpp: where tools begin and where their paths lead
Remarks tool_remarks(const Scene& scene, const Bodies& bodies);
// picture_remarks.cpp: whether there is anything to see
Remarks picture_remarks(const Scene& scene, const Bodies& bodies);

/// Box round the rest positions of a body's masses and of its scenery [m].
Eigen::AlignedBox3d box_of(const Body& body);
/// Is there anything besides a hold that would stop a fall: gravity, and no floor or wall below?
bool falls_for_ever(const Scene& scene);
/// Is the body one that a hand leads?
bool is_tool(const Scene& scene, const Body& body);

}  // namespace palpate::physics
