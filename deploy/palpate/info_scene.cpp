#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "common/math/hash.h"
#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "deploy/palpate/info.h"
#include "physics_node/forecast/memory_need.h"
#include "physics_node/forecast/speed_forecast.h"
#include "physics_node/mesh/mesh_quality.h"
#include "physics_node/remarks/first_touch.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/world.h"

namespace palpate::deploy {
namespace {

struct ShapeText {
  std::string operator()(const SphereShape& shape) const {
    return fmt::format("sphere of radius {:.6g} mm", mm_from_m(shape.radius));
  }
  std::string operator()(const BoxShape& shape) const {
    return fmt::format("box of {:.6g} x {:.6g} x {:.6g} mm", mm_from_m(shape.size[0]),
                       mm_from_m(shape.size[1]), mm_from_m(shape.size[2]));
  }
  std::string operator()(const TubeShape& shape) const {
    const auto wall = shape.wall_layers
                          ? fmt::format("radius {:.6g} mm, a wall of {} layers",
                                        mm_from_m(shape.outer_radius), *shape.wall_layers)
                          : fmt::format("radius {:.6g} to {:.6g} mm", mm_from_m(shape.inner_radius),
                                        mm_from_m(shape.outer_radius));
    return fmt::format("tube of {}, {:.6g} mm long", wall, mm_from_m(shape.length));
  }
  std::string operator()(const KnifeShape& shape) const {
    return fmt::format("knife of {:.6g} x {:.6g} mm", mm_from_m(shape.length), mm_from_m(shape.height));
  }
  std::string operator()(const NeedleShape& shape) const {
    return fmt::format("needle of diameter {:.6g} mm, {:.6g} mm long, sharpened to {:.6g} degrees",
                       mm_from_m(shape.diameter), mm_from_m(shape.length), deg_from_rad(shape.sharpening));
  }
  std::string operator()(const VolumeShape& shape) const {
    if (shape.slices)
      return fmt::format("{} slices from {}, intensity {:.6g} to {:.6g}", shape.slices->files.size(),
                         shape.slices->files.front(), shape.keep_min, shape.keep_max);
    return fmt::format("volume {}, intensity {:.6g} to {:.6g}", shape.file, shape.keep_min, shape.keep_max);
  }
  std::string operator()(const MeshShape& shape) const {
    return shape.metres == 1
               ? fmt::format("mesh {}", shape.file)
               : fmt::format("mesh {} in units of {:.6g} mm", shape.file, mm_from_m(shape.metres));
  }
};

/// What its masses stand on.
std::string structure_text(const BodySpec& body, const physics::Body& built) {
  if (!built.mesh) return body.lattice == LatticeKind::fcc ? "fcc lattice" : "voxel lattice";
  if (physics::is_surface_of_springs(built))
    return fmt::format("{} springs on {} triangles with {} nodes, edges of {:.3g} mm", built.n_elements(),
                       built.mesh->faces.size(), built.n_nodes(), mm_from_m(built.spacing()));
  constexpr const char* kinds[] = {"plain", "nodal pressure", "second order"};
  const physics::DihedralAngles angles = physics::dihedral_angles(built.mesh->model.mesh);
  return fmt::format(
      "{} tetrahedra ({}) with {} nodes, faces of {:.3g} mm, dihedral angles {:.3g} to {:.3g} degrees",
      built.n_elements(), kinds[static_cast<int>(body.tet_elements)], built.n_nodes(),
      mm_from_m(built.spacing()), deg_from_rad(angles.least), deg_from_rad(angles.largest));
}

std::string body_text(const BodySpec& body, const physics::Body& built) {
  std::string text = fmt::format("body         {}: {}, {}", body.name, std::visit(ShapeText{}, body.shape),
                                 structure_text(body, built));
  if (body.spacing) text += fmt::format(" of {:.6g} mm", mm_from_m(*body.spacing));
  text += fmt::format(", material {}", body.material);
  for (const auto& region : body.regions) text += fmt::format(", {} in a region", region.material);
  if (!body.cavities.empty()) text += fmt::format(", {} cavities", body.cavities.size());
  return text + "\n";
}

std::string material_text(const MaterialSpec& material) {
  std::string text = fmt::format("material     {}:", material.name);
  if (material.mass) text += fmt::format(" {:.6g} g a mass,", *material.mass * 1e3);
  if (material.density) text += fmt::format(" {:.6g} kg/m^3,", *material.density);
  if (material.k1) text += fmt::format(" k1 {:.6g} N/m,", *material.k1);
  if (material.modulus) text += fmt::format(" modulus {:.6g} kPa,", *material.modulus * 1e-3);
  if (material.lambda) text += fmt::format(" {:.6g} N per stretch,", *material.lambda);
  text += fmt::format(" k2/k1 {:.6g}", material.k2_ratio);
  if (material.yield_ratio) text += fmt::format(", yields at {:.6g}", *material.yield_ratio);
  if (material.break_ratio) text += fmt::format(", breaks at {:.6g}", *material.break_ratio);
  if (material.fracture_energy)
    text += fmt::format(", a crack takes {:.6g} J/m^2", *material.fracture_energy);
  if (material.cut_toughness)
    text += fmt::format(", a blade or needle takes {:.6g} J/m^2", *material.cut_toughness);
  return text + "\n";
}

std::string tool_text(const ToolSpec& tool, const Scene& scene) {
  if (tool.shape == ToolShape::body)
    return fmt::format("tool         {}: body {}, device {} (driver {})\n", tool.name, tool.body, tool.device,
                       scene.device(tool.device).driver);
  if (tool.shape == ToolShape::scalpel)
    return fmt::format("tool         {}: scalpel, edge {:.6g} mm, {:.6g} N/m, device {} (driver {})\n",
                       tool.name, mm_from_m(tool.length), tool.stiffness, tool.device,
                       scene.device(tool.device).driver);
  if (tool.shape == ToolShape::scissors)
    return fmt::format(
        "tool         {}: scissors, blades {:.6g} mm, mouth {:.6g} mm, {:.6g} N/m, device {} (driver {})\n",
        tool.name, mm_from_m(tool.length), mm_from_m(tool.scissors.mouth()), tool.stiffness, tool.device,
        scene.device(tool.device).driver);
  if (tool.shape == ToolShape::needle)
    return fmt::format("tool         {}: needle {:.6g} x {:.6g} mm, {:.6g} N/m, device {} (driver {})\n",
                       tool.name, 2 * mm_from_m(tool.radius), mm_from_m(tool.length), tool.stiffness,
                       tool.device, scene.device(tool.device).driver);
  if (tool.shape == ToolShape::forceps)
    return fmt::format(
        "tool         {}: forceps, jaws of {:.6g} mm, grip {:.6g} N, {:.6g} N/m, device {} (driver {})\n",
        tool.name, mm_from_m(tool.radius), tool.grip, tool.stiffness, tool.device,
        scene.device(tool.device).driver);
  if (tool.shape == ToolShape::box)
    return fmt::format(
        "tool         {}: box {:.6g} x {:.6g} x {:.6g} mm, {:.6g} N/m, device {} (driver {})\n", tool.name,
        mm_from_m(tool.size.x()), mm_from_m(tool.size.y()), mm_from_m(tool.size.z()), tool.stiffness,
        tool.device, scene.device(tool.device).driver);
  return fmt::format("tool         {}: radius {:.6g} mm, {:.6g} N/m, device {} (driver {})\n", tool.name,
                     mm_from_m(tool.radius), tool.stiffness, tool.device, scene.device(tool.device).driver);
}

/// How many masses move, what they take and how fast they go.
std::string forecast_text(const Scene& scene, const physics::World& world) {
  using namespace physics;
  double bytes = bytes_of_program;
  std::vector<double> masses;
  double all = 0;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const BodySpec& spec = scene.bodies[b];
    const MemoryNeed need = memory_need(spec, scene);
    const auto built = static_cast<double>(world.body(b).body().n_nodes());
    masses.push_back(stepped_masses(world.body(b).body()));
    all += built;
    bytes += need.bytes - bytes_of_masses(need.masses, spec, scene) + bytes_of_masses(built, spec, scene);
  }
  const double stepped = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::string text = fmt::format("masses       {:.0f}", all);
  if (stepped < all) text += fmt::format(", of which about {:.2g} are awake under a finger", stepped);
  text += "\n";
  text += fmt::format("memory       about {:.2g} GB of {:.2g} GB that may be taken here\n", 1e-9 * bytes,
                      1e-9 * usable_memory());
  const double stable_dt = world.stable_step_seconds();
  if (!std::isfinite(stable_dt)) return text;
  const SpeedForecast speed = forecast_speed(world.scene(), masses, stable_dt);
  text += fmt::format("step         {:.0f} a frame of {:.3g} ms\n", speed.steps_a_frame,
                      1e3 / scene.physics->frame_Hz);
  if (speed.real_time_factor > 0)
    text += fmt::format("speed        about {:.2g} x real time on one thread, without contact\n",
                        speed.real_time_factor);
  return text;
}

/// When and where each path first meets a body at rest.
std::string touch_text(const Scene& scene, const physics::World& world) {
  physics::Bodies bodies;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) bodies.push_back(&world.body(b));
  std::string text;
  for (const ToolSpec& tool : scene.tools) {
    if (!physics::may_know_first_touch(scene, bodies, tool)) continue;
    const auto touch = physics::first_touch(scene, bodies, tool);
    text += touch ? fmt::format("touch        {} meets {} after {:.4g} s at ({:.4g}, {:.4g}, {:.4g}) mm\n",
                                tool.name, scene.bodies[touch->body].name, touch->t, mm_from_m(touch->at.x()),
                                mm_from_m(touch->at.y()), mm_from_m(touch->at.z()))
                  : fmt::format("touch        {}: its path never meets a body at rest\n", tool.name);
  }
  return text;
}

}  // namespace

std::string info_scene(const std::string& path) {
  const Scene scene = load_scene(path);
  const physics::World world(scene);
  std::string text = fmt::format("scene        {}\n", scene.title);
  text += fmt::format("checksum     {}\n", hex_of(scene.checksum));
  text += fmt::format("lasts        {:.6g} s\n", scene.natural_seconds());
  text += forecast_text(scene, world);
  for (std::size_t b = 0; b < world.n_bodies(); ++b) text += body_text(scene.bodies[b], world.body(b).body());
  for (const auto& material : scene.materials) text += material_text(material);
  for (const auto& tool : scene.tools) text += tool_text(tool, scene);
  text += touch_text(scene, world);
  for (const auto& line : world.remarks()) text += fmt::format("remark       {}\n", line);
  for (const auto& line : physics::remarks_about(world)) text += fmt::format("remark       {}\n", line);
  return text;
}

}  // namespace palpate::deploy
