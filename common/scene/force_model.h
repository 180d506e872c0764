#pragma once
// What the hand feels of a tool between two answers of physics: decided here, and nowhere else. The reader, the hand's
// node, physics, the window and the bench ask.

#include <string>

#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"
#include "common/scene/tool_spec.h"

namespace palpate {

/// The word of the scene file.
const char* word_of(ForceModel model) noexcept;

/// May a scene ask for it? Planes are of points; a tangent is of sticks and bodies; a copy of tissue of all but bodies.
bool can_feel(ToolShape shape, ForceModel model) noexcept;

/// Puts into each point what it feels where the scene does not say: a copy of tissue where all bodies are finite elements
/// whose cells follow the tip and steps are explicit, else planes.
void settle_force_models(Scene& scene);

/// As the scene has it, else as settled for a point, a copy of tissue for cylinders, cones and boxes, a tangent for all others.
/// Physics and the window go by this: they do not know the device, and answer alike whichever of `tangent` and `norton` felt_force_model() makes of it.
ForceModel force_model_of(const ToolSpec& tool) noexcept;

struct ForceModelChoice {
  ForceModel model = ForceModel::norton;
  bool lacks_torques = false;  // the plane under a stick stands in for its wrench
  bool was_asked = false;      // the scene names what the device cannot give
};

/// What this tool can feel in this hand.
/// @param torque_limit  what the device gives, in the world; 0: none [N m]
ForceModelChoice felt_force_model(const ToolSpec& tool, double torque_limit) noexcept;

/// ", feels norton: the plane under it, as the device gives no torques"
std::string words_of(const ForceModelChoice& choice);
/// A warning where the device cannot give what the scene names; else empty.
std::string warning_of(const ForceModelChoice& choice);

}  // namespace palpate
