#include "bench/parts/pressed_block.h"

#include <fmt/format.h>

#include <filesystem>

#include "bench/problems/block_image.h"
#include "bench/problems/stopwatch.h"
#include "common/message/vec3.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

std::string made_image(const PressedBlock& block) {
  const std::string path = block.folder + "/block.h5";
  write_block_image(block.cells, block.edge, path);
  return path;
}

Scene scene_of(const PressedBlock& block) {
  return parse_scene(
      fmt::format(R"(title = "block"
gravity_m_per_s2 = [0, 0, 0]
[[body]]
name = "block"
model = "fem"
shape = "volume"
file = "{}"
keep = [0, 1000]
deformable = {}
{}
material = "soft"
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 10
poisson_ratio = {}
viscosity_Pa_s = 2
[[tool]]
name = "tip"
shape = "point"
radius_mm = {}
force_model = "norton"
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 1000], [1, 0, 0, 1000]]
)",
                  std::filesystem::absolute(made_image(block)).string(),
                  block.awake ? fmt::format("{{ awake_mm = {} }}", 1e3 * *block.awake) : "\"all\"",
                  block.held ? "fixed = [\"-z\"]" : "", block.poisson_ratio, 1e3 * block.tip),
      "block.toml");
}

}  // namespace

Pressed press(const PressedBlock& block, int frames, const std::function<Press(int)>& way) {
  physics::World world(scene_of(block));
  const double top = 0.5 * block.edge * block.cells[2];
  const Vec3 middle(0.13 * block.edge, 0.29 * block.edge, top);  // Why: on no node and no edge
  Pressed pressed;
  const Stopwatch watch;
  for (int n = 0; n < frames; ++n) {
    const Press now = way(n);
    ToolState state;
    state.tick = static_cast<std::uint64_t>(n) + 1;
    const Vec3 at = middle + now.beside;
    state.p_WT = state.proxy = {at.x(), at.y(), at.z()};
    state.force_on_hand = state.force_now = {0, 0, now.force};
    state.engaged = 1;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
    pressed.depth.push_back(dynamic_cast<const physics::PointTool&>(world.tool(0)).depth());
  }
  pressed.cpu_s = watch.cpu_s();
  pressed.awake_share = 1 - world.body(0).sleeping_fraction();
  const physics::EnergyLedger ledger = world.ledger();
  pressed.numerical = ledger.numerical;
  pressed.exchanged = ledger.exchanged;
  pressed.off = ledger.balance_error();
  return pressed;
}

}  // namespace palpate::bench
