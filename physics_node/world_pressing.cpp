// The part of a frame that tools have which press with forces.

#include <algorithm>

#include "physics_node/world.h"

namespace palpate::physics {

bool World::is_pressed() const noexcept {
  return std::any_of(toolbox_.pressing.begin(), toolbox_.pressing.end(),
                     [](const PressingTool* tool) { return !tool->forces().empty(); });
}

void World::gather() noexcept {
  for (auto& forces : gathered_) forces.clear();
  for (const PressingTool* tool : toolbox_.pressing)
    if (!tool->follows_steps() && !tool->forces().empty()) {
      auto& to = gathered_[tool->touched_body()];
      to.insert(to.end(), tool->forces().begin(), tool->forces().end());
    }
}

/// Of the forces of tools that press, where no step has solved for them.
/// @param begun  false: of those alone that are known before a step [W]
double World::tools_power(bool begun) const noexcept {
  double sum = 0;
  if (is_implicit()) return sum;
  for (const PressingTool* tool : toolbox_.pressing)
    if ((begun || !tool->follows_steps()) && !tool->forces().empty())
      sum += bodies_[tool->touched_body()]->power(tool->forces());
  return sum;
}

/// Tools that follow steps: their forces act in the step just integrated. @return as PressingTool::press() [W]
double World::press(double dt) noexcept {
  double sum = 0;
  for (PressingTool* tool : toolbox_.pressing) {
    if (!tool->follows_steps()) continue;
    const StageTimer timer(report_, Stage::contact_forces);
    sum += tool->press(dt);
    if (!tool->forces().empty()) bodies_[tool->touched_body()]->kick(tool->forces(), dt);
  }
  return sum;
}

}  // namespace palpate::physics
