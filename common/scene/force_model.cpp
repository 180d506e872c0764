#include "common/scene/force_model.h"

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate {

const char* word_of(ForceModel model) noexcept {
  switch (model) {
    case ForceModel::norton:
      return "norton";
    case ForceModel::tangent:
      return "tangent";
    case ForceModel::raw_planes:
      return "raw_planes";
    case ForceModel::direct:
      return "direct";
    case ForceModel::tissue:
      return "tissue";
  }
  return "";
}

bool can_feel(ToolShape shape, ForceModel model) noexcept {
  if (feels_slope(shape)) return model == ForceModel::tangent;
  if (is_solid_tip(shape) || model == ForceModel::tissue)
    return model == ForceModel::tissue && shape != ToolShape::body;
  if (model == ForceModel::direct) return true;
  return (shape == ToolShape::point) == (model != ForceModel::tangent);
}

void settle_force_models(Scene& scene) {
  const bool steps = scene.physics->integrator != Integrator::backward_euler;
  for (ToolSpec& tool : scene.tools) {
    const auto copied = [&](const BodySpec& body) {
      return body.model == ElementModel::fem && body.spacing && follows_shape(*body.spacing, tool.radius);
    };
    if (tool.shape == ToolShape::point && tool.contact != PointContact::nodes && steps &&
        !scene.bodies.empty() && std::ranges::all_of(scene.bodies, copied))
      tool.own_model = ForceModel::tissue;
  }
}

ForceModel force_model_of(const ToolSpec& tool) noexcept {
  if (is_solid_tip(tool.shape)) return ForceModel::tissue;
  return tool.force_model.value_or(tool.shape == ToolShape::point ? tool.own_model : ForceModel::tangent);
}

ForceModelChoice felt_force_model(const ToolSpec& tool, double torque_limit) noexcept {
  const ForceModel asked = force_model_of(tool);
  // A stick offers its surface as a plane, too, and that says all to a hand that cannot be turned. A body offers none.
  if (tool.shape != ToolShape::stick || asked != ForceModel::tangent || torque_limit > 0) return {asked};
  return {.model = ForceModel::norton, .lacks_torques = true, .was_asked = tool.force_model.has_value()};
}

std::string words_of(const ForceModelChoice& choice) {
  const std::string word = word_of(choice.model);
  return choice.lacks_torques ? word + ": the plane under the stick, as the device gives no torques" : word;
}

std::string warning_of(const ForceModelChoice& choice) {
  if (!choice.was_asked) return {};
  return "force_model = \"tangent\" needs torques, which this device does not give; the hand feels the plane "
         "under "
         "the stick (norton); leave force_model out, or take a device with torques";
}

}  // namespace palpate
