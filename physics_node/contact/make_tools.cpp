#include "physics_node/contact/make_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/force_model.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/blade_tool.h"
#include "physics_node/contact/body_tool.h"
#include "physics_node/contact/grip_tool.h"
#include "physics_node/contact/needle_tool.h"
#include "physics_node/contact/stick_tool.h"
#include "physics_node/contact/tissue_tool.h"

namespace palpate::physics {
namespace {

/// @throws InputError  where steps are implicit; what the tool does step by step, and what to write instead
void refuse_implicit(const Scene& scene, const ToolSpec& tool, const std::string& what,
                     const std::string& instead = {}) {
  if (scene.physics->integrator == Integrator::backward_euler)
    throw InputError(tool.place.text() + ": " + what + ", which \"backward_euler\" does not; write " +
                     instead + "integrator = \"symplectic_euler\"");
}

void add_pressing(std::unique_ptr<PressingTool> tool, const BodyModels& bodies, Toolbox& box) {
  box.pressing.push_back(tool.get());
  box.tools.push_back(std::move(tool));
  for (const auto& body : bodies) body->prepare_for(Disturbance::forces);
}

void add_point(const Scene& scene, std::uint32_t n, const BodyModels& bodies,
               const std::vector<TouchableBody>& touchable, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  if (spec.contact == PointContact::faces)
    refuse_implicit(scene, spec, "contact = \"faces\" presses step by step", "contact = \"nodes\", or ");
  auto point = std::make_unique<PointTool>(spec, n, touchable, scene.physics->integrator);
  add_pressing(std::move(point), bodies, box);
}

/// A rigid tool that the hand's motion presses. @param n  of the tool
void add_tissue(const Scene& scene, std::uint32_t n, const BodyModels& bodies,
                const std::vector<TouchableBody>& touchable, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  refuse_implicit(scene, spec, "force_model = \"tissue\" presses step by step",
                  "force_model = \"norton\", or ");
  auto tool = std::make_unique<TissueTool>(spec, n, touchable, 1 / scene.device(spec.device).rate_Hz,
                                           1 / scene.physics->frame_Hz, scene.physics->integrator);
  add_pressing(std::move(tool), bodies, box);
}

/// @throws InputError  scissors that would go on by more than a cell in a frame, past what is listed for it
void refuse_skipping(const Scene& scene, const ToolSpec& spec, const BodyModels& bodies) {
  double finest = HUGE_VAL;
  for (const auto& body : bodies) finest = std::min(finest, body->body().spacing());
  const ScissorsSpec& blades = spec.scissors;
  const double way = blades.speed() / scene.physics->frame_Hz;
  if (way <= finest) return;
  throw InputError(fmt::format(
      "{}: scissors that close in {:g} s go on by {:.3g} mm in a frame, beyond cells of {:.3g} mm; write "
      "close_s = {:.2g} or more, or a higher frame_Hz",
      spec.place.text(), blades.close_s, 1e3 * way, 1e3 * finest, 1.05 * blades.close_s * way / finest));
}

void add_blade(const Scene& scene, std::uint32_t n, const BodyModels& bodies,
               const std::vector<TouchableBody>& touchable, const Connections& connections, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  const bool scissors = spec.shape == ToolShape::scissors;
  refuse_implicit(scene, spec, scissors ? "scissors cut step by step" : "a scalpel cuts step by step");
  for (const ConnectionSpec& joint : scene.connections)
    if (!joint.cut_toughness)
      throw InputError(
          fmt::format("{}: shape = \"{}\" needs to know how tough connection \"{}\" is; give that "
                      "cut_toughness_J_per_m2, such as 100",
                      spec.place.text(), blade_name(spec), joint.name));
  if (scissors) refuse_skipping(scene, spec, bodies);
  auto blade = std::make_unique<BladeTool>(spec, n, bodies, touchable, connections,
                                           1 / scene.device(spec.device).rate_Hz);
  add_pressing(std::move(blade), bodies, box);
}

void add_forceps(const Scene& scene, std::uint32_t n, const BodyModels& bodies, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  refuse_implicit(scene, spec, "forceps hold step by step");
  auto grip = std::make_unique<GripTool>(spec, n, bodies, 1 / scene.device(spec.device).rate_Hz);
  add_pressing(std::move(grip), bodies, box);
}

void add_needle(const Scene& scene, std::uint32_t n, const BodyModels& bodies,
                const std::vector<TouchableBody>& touchable, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  refuse_implicit(scene, spec, "a needle pierces step by step");
  auto needle =
      std::make_unique<NeedleTool>(spec, n, bodies, touchable, 1 / scene.device(spec.device).rate_Hz);
  add_pressing(std::move(needle), bodies, box);
}

void add_stick(const Scene& scene, std::uint32_t n, const BodyModels& bodies,
               const std::vector<TouchableBody>& touchable, Toolbox& box) {
  const ToolSpec& spec = scene.tools[n];
  refuse_implicit(scene, spec, "a stick moves masses step by step");
  auto stick = std::make_unique<StickTool>(spec, n, bodies, touchable);
  box.led.push_back(stick.get());
  box.tools.push_back(std::move(stick));
  for (const auto& body : bodies) body->prepare_for(Disturbance::impulses);
}

void add_body(const ToolSpec& spec, std::uint32_t n, const BodyModels& bodies, Toolbox& box) {
  std::size_t b = 0;
  while (b < bodies.size() && bodies[b]->body().name != spec.body) ++b;
  PALPATE_CHECK(b < bodies.size() && !bodies[b]->body().handle.empty(),
                "a tool names a body that has a handle");
  auto tool = std::make_unique<BodyTool>(spec, n, b, *bodies[b]);
  box.led.push_back(tool.get());
  box.felt.push_back(b);
  box.tools.push_back(std::move(tool));
}

}  // namespace

Toolbox make_tools(const Scene& scene, const BodyModels& bodies, const std::vector<TouchableBody>& touchable,
                   const Connections& connections) {
  Toolbox box;
  for (std::uint32_t n = 0; n < scene.tools.size(); ++n) {
    const ToolSpec& spec = scene.tools[n];
    if (force_model_of(spec) == ForceModel::tissue)
      add_tissue(scene, n, bodies, touchable, box);
    else if (spec.shape == ToolShape::point)
      add_point(scene, n, bodies, touchable, box);
    else if (cuts(spec))
      add_blade(scene, n, bodies, touchable, connections, box);
    else if (spec.shape == ToolShape::forceps)
      add_forceps(scene, n, bodies, box);
    else if (spec.shape == ToolShape::needle)
      add_needle(scene, n, bodies, touchable, box);
    else if (spec.shape == ToolShape::stick)
      add_stick(scene, n, bodies, touchable, box);
    else
      add_body(spec, n, bodies, box);
  }
  return box;
}

}  // namespace palpate::physics
