#include "bench/haptic/world_object.h"

#include <fmt/format.h>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::bench {

Scene slab_scene(const SlabModel& slab, std::optional<ForceModel> model, double rate_Hz,
                 double hand_stiffness, double hand_damping, double friction) {
  constexpr double thick_mm = 16, radius_mm = 5, stick_radius_mm = 3;
  const double top_mm = slab.stick ? -stick_radius_mm : 0.0;
  const std::string tool =
      slab.stick ? fmt::format("shape = \"stick\"\nlength_mm = 60\nradius_mm = {}\ntheta_deg = [0, -90, 0]\n",
                               stick_radius_mm)
                 : fmt::format("shape = \"point\"\nradius_mm = {}\n", radius_mm);
  Scene scene = parse_scene(
      fmt::format(
          "title = \"slab\"\ngravity_m_per_s2 = [0, 0, 0]\n[physics]\nframe_Hz = {}\nthreads = 1\n"
          "[material.tissue]\ndensity_kg_per_m3 = 1000\n{}\n"
          "[[body]]\nname = \"slab\"\nlattice = \"voxel\"\nspacing_mm = 4\nmaterial = \"tissue\"\n"
          "shape = \"box\"\nsize_mm = [64, 40, {}]\nat_mm = [10, 0, {}]\nfixed = [{}]\n{}\n"
          "[[tool]]\nname = \"tool\"\n{}device = \"hand\"\nstiffness_N_per_m = {}\ndamping_N_s_per_m = {}\n"
          "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 20], [1, 0, 0, 20]]\n",
          rate_Hz, slab.material, thick_mm, top_mm - thick_mm / 2,
          slab.held ? "{ min_mm = [-100, -100, -100], max_mm = [100, 100, 100] }" : "\"-z\"", slab.body, tool,
          hand_stiffness, hand_damping),
      slab.name);
  scene.tools[0].force_model = model;
  scene.tools[0].friction = friction;
  return scene;
}

void WorldObject::frame(const ToolState* hand, double table, std::int64_t now_ns, ContactPatch& patch,
                        ToolWrench& wrench) {
  std::optional<ToolState> state = hand == nullptr ? std::nullopt : std::optional(*hand);
  if (state) {
    state->p_WT[2] -= table;
    state->proxy[2] -= table;
  }
  world_.frame(std::span(&state, 1));
  const auto number = static_cast<std::uint64_t>(world_.report().frames);
  world_.tool(0).write_wrench(wrench, number, now_ns, world_.t());
  world_.tool(0).write_patch(patch, number, now_ns);
  for (Array3* p : {&wrench.p_WT, &wrench.set_point, &wrench.tip}) (*p)[2] += table;
  for (std::size_t i = 0; i < patch.n_tissues; ++i) patch.tissues[i].rest[2] += table;
  for (std::size_t i = 0; i < patch.n_facets; ++i) {
    patch.facets[i].point[2] += table;
    for (Array3& corner : patch.facets[i].corners) corner[2] += table;
  }
}

}  // namespace palpate::bench
