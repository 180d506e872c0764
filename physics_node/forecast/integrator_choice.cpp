#include "physics_node/forecast/integrator_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

bool any_cells(const Scene& scene) {
  return std::ranges::any_of(scene.bodies,
                             [](const BodySpec& body) { return body.model == ElementModel::fem; });
}

/// What of the scene needs explicit steps, with what would not; empty: nothing.
std::string what_needs_steps(const Scene& scene) {
  for (const MaterialSpec& material : scene.materials) {
    const std::string what = beyond_elastic(material);
    const auto has_it = [&](const BodySpec& body) { return has_material(body, material.name); };
    if (!what.empty() && std::ranges::any_of(scene.bodies, has_it))
      return fmt::format("[material.{}] {}", material.name, what);
  }
  for (const BodySpec& body : scene.bodies)
    if (const auto* image = std::get_if<VolumeShape>(&body.shape);
        image != nullptr && image->deformable.awake)
      return fmt::format("body \"{}\" is awake in parts, step by step", body.name);
  for (const ToolSpec& tool : scene.tools) {
    if (is_solid_tip(tool.shape)) return fmt::format("tool \"{}\" presses faces step by step", tool.name);
    if (tool.shape == ToolShape::scalpel)
      return fmt::format("tool \"{}\" is a scalpel, which cuts step by step", tool.name);
    if (tool.shape == ToolShape::scissors)
      return fmt::format("tool \"{}\" is a pair of scissors, which cut step by step", tool.name);
    if (tool.shape == ToolShape::forceps)
      return fmt::format("tool \"{}\" is a pair of forceps, which hold step by step", tool.name);
    if (tool.shape == ToolShape::needle)
      return fmt::format("tool \"{}\" is a rigid needle, which pierces step by step", tool.name);
    if (tool.shape == ToolShape::stick)
      return fmt::format("tool \"{}\" is a stick, which moves masses step by step", tool.name);
    if (tool.shape == ToolShape::point && asks_for_faces(tool, any_cells(scene)))
      return fmt::format("tool \"{}\" presses faces step by step; contact = \"nodes\" would do without",
                         tool.name);
  }
  return {};
}

}  // namespace

IntegratorChoice choose_integrator(const Scene& scene, double explicit_dt) {
  const double steps = 1 / (scene.physics->frame_Hz * scene.physics->safety * explicit_dt);
  const double worth = any_cells(scene) ? worth_solving_cells : worth_solving_springs;
  if (!std::isfinite(explicit_dt) || scene.physics->step || steps < worth) return {};
  const std::string where = scene.physics->place.text();
  if (const std::string what = what_needs_steps(scene); !what.empty())
    return {Integrator::symplectic_euler,
            fmt::format("{}: \"auto\" takes {:.0f} explicit steps a frame, where \"backward_euler\" would be "
                        "cheaper, since {}",
                        where, std::ceil(steps), what)};
  return {
      Integrator::backward_euler,
      fmt::format("{}: \"auto\" takes \"backward_euler\" in place of {:.0f} explicit steps a frame; it damps "
                  "what swings faster than the frames",
                  where, std::ceil(steps))};
}

}  // namespace palpate::physics
