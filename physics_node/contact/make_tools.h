#pragma once
// From the tools of a scene to what presses its bodies.

#include <memory>
#include <string>
#include <vector>

#include "physics_node/connection/connection.h"
#include "physics_node/contact/led_tool.h"
#include "physics_node/contact/point_tool.h"

namespace palpate::physics {

struct Toolbox {
  std::vector<std::unique_ptr<Tool>> tools;  // one for each of the scene
  std::vector<PressingTool*> pressing;       // those of them that press tissue with forces: points
  std::vector<LedTool*> led;                 // those that move masses themselves: bodies and sticks
  std::vector<std::size_t> felt;             // bodies whose impulses somebody feels
};

/// Makes them, and has the bodies make room for what these tools want to know.
/// @throws InputError  where a tool cannot work with the scene's integrator, or with what it is to cut
Toolbox make_tools(const Scene& scene, const BodyModels& bodies, const std::vector<TouchableBody>& touchable,
                   const Connections& connections);

}  // namespace palpate::physics
