#include "bench/stress/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/problems/dice.h"
#include "bench/problems/settings.h"
#include "common/message/vec3.h"
#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {
namespace {

constexpr double g = 9.81;

MaterialSpec material(Dice& dice, const std::string& name, double modulus, double density, bool yields,
                      bool breaks) {
  MaterialSpec m;
  m.name = name;
  m.modulus = modulus;
  m.density = density;
  if (yields) {
    m.k2_ratio = dice.between(0, 1);
    m.yield_ratio = 1 + dice.decades(1e-3, 0.5);
    m.break_ratio = breaks ? *m.yield_ratio + dice.decades(1e-3, 0.5) : *m.yield_ratio + 100;
  }
  return m;
}

BodySpec body(Dice& dice, double spacing, double target_masses) {
  BodySpec spec = box_body(dice.chance(0.5) ? LatticeKind::fcc : LatticeKind::voxel, Vec3::Zero(), spacing);
  // A box of random proportions that holds about so many masses.
  const Vec3 shape(dice.decades(0.3, 3), dice.decades(0.3, 3), dice.decades(0.3, 3));
  const double density =
      spec.lattice == LatticeKind::fcc ? std::numbers::sqrt2 : 1.0;  // masses per spacing^3
  const double scale = spacing * std::cbrt(target_masses / density / shape.prod());
  spec.shape = BoxShape{(scale * shape).cwiseMax(1.01 * spacing)};
  spec.at = dice.within(0.5 * spacing);
  if (dice.chance(0.4)) spec.fixed_faces[static_cast<std::size_t>(dice.pick(6))] = true;
  return spec;
}

Scene bodies_and_materials(Dice& dice) {
  Scene scene = empty_scene();
  scene.physics->sleep = dice.chance(0.5);
  const double modulus = dice.decades(10, 1e9), density = dice.decades(1e2, 1e4),
               spacing = dice.decades(1e-3, 0.1);
  const bool yields = dice.chance(0.5), breaks = dice.chance(0.7);
  scene.materials = {material(dice, "m", modulus, density, yields, breaks),
                     material(dice, "other", modulus * dice.decades(0.01, 100),
                              density * dice.decades(0.01, 100), yields, breaks)};
  const int damping = dice.pick(4);
  for (auto& m : scene.materials) {
    if (damping > 0) m.viscosity_bulk = *m.modulus * dice.decades(1e-5, 1e-1) * spacing;
    if (damping == 2) m.damper = Damper::relative;
    if (damping == 3) m.damper = Damper::drag;
  }
  scene.bodies = {body(dice, spacing, dice.decades(50, 1500))};
  if (dice.chance(0.4))  // half of the body is of the other material
    scene.bodies[0].regions = {
        {"other", BoxRegion{Vec3::Constant(-10), Vec3(scene.bodies[0].at.x(), 10, 10)}, {}}};
  if (dice.chance(0.3)) {
    BodySpec second = body(dice, spacing * dice.decades(0.5, 2), dice.decades(50, 500));
    second.name = "second";
    second.material = "other";
    second.at += Vec3(0, 0, 20 * spacing);
    scene.bodies.push_back(second);
  }
  return scene;
}

/// The same abuse of finite elements. Dice of its own, so that a seed of springs is what it was.
void make_solid(std::uint64_t seed, Scene& scene) {
  Dice dice(seed * 2654435761U + 7);
  const double nu = dice.chance(0.3) ? dice.between(0.45, 0.495) : dice.between(0, 0.45);
  const bool damped = scene.materials[0].viscosity_bulk.has_value();
  const double lag = dice.decades(1e-6, 1e-2);  // [s]
  const auto law = dice.chance(0.2) ? TissueLaw::green : TissueLaw::neo_hookean;
  const auto hourglass = dice.chance(0.3) ? HourglassKind::isotropic : HourglassKind::physical;
  std::vector<RelaxationSpec> relaxation;
  if (law == TissueLaw::neo_hookean && hourglass == HourglassKind::physical && dice.chance(0.3))
    for (int n = 1 + dice.pick(4); n > 0; --n)
      relaxation.push_back({.share = dice.between(0.01, 0.2), .time = dice.decades(1e-3, 1e2)});
  for (MaterialSpec& m : scene.materials) {
    m.poisson_ratio = nu;
    m.law = law;
    m.relaxation = relaxation;
    const bool flows =
        law == TissueLaw::neo_hookean && hourglass == HourglassKind::physical && relaxation.empty();
    if (!flows) m.yield_ratio.reset();
    if (law != TissueLaw::neo_hookean || !relaxation.empty()) m.break_ratio.reset();
    m.damper = Damper::axial;
    m.viscosity_bulk.reset();
    if (damped) m.viscosity_bulk = lag * *m.modulus;
  }
  for (MaterialSpec& m : scene.materials)
    if (m.break_ratio && dice.chance(0.5)) m.fracture_energy = dice.decades(1e-3, 1e3) * *m.modulus * 1e-3;
  for (BodySpec& body : scene.bodies) {
    body.lattice = LatticeKind::voxel;
    body.model = ElementModel::fem;
    body.hourglass = hourglass;
  }
}

Integrator integrator_of(const Scene& scene, Dice& dice) {
  const auto integrator = static_cast<Integrator>(dice.pick(3));
  if (scene.bodies[0].model == ElementModel::springs) return integrator;
  const MaterialSpec& m = scene.materials[0];
  const bool implicit =
      integrator == Integrator::backward_euler && m.relaxation.empty() && m.law == TissueLaw::neo_hookean &&
      std::ranges::none_of(scene.materials,
                           [](const MaterialSpec& of) { return of.yield_ratio || of.break_ratio; });
  return implicit ? integrator : Integrator::symplectic_euler;
}

}  // namespace

StressScene random_scene(std::uint64_t seed, ElementModel model) {
  Dice dice(seed * 2654435761U + 1);
  StressScene stress;
  stress.seed = seed;
  stress.scene = bodies_and_materials(dice);
  Scene& scene = stress.scene;
  if (model == ElementModel::fem) make_solid(seed, scene);
  scene.physics->precision = dice.chance(0.5) ? Precision::single_ : Precision::double_;
  scene.physics->threads = dice.chance(0.1) ? 2 : 1;
  if (dice.chance(0.7)) scene.gravity = dice.within(1).normalized() * dice.decades(0.01, 1000) * g;
  const double spacing = *scene.bodies[0].spacing;
  if (dice.chance(0.4)) scene.floor = FloorSpec{scene.bodies[0].at.z() - dice.between(-1, 5) * spacing};

  stress.start = static_cast<Start>(dice.pick(5));
  stress.amount = stress.start == Start::shaken ? dice.decades(0.01, 100) : dice.decades(0.01, 2);
  if (dice.chance(0.5)) {
    stress.tool_speed = dice.decades(0.1, 100);
    stress.tool_force = dice.decades(0.01, 1000);
    DeviceSpec device;
    device.name = "hand";
    device.driver = "simulated";
    scene.devices = {device};
    ToolSpec tool;
    tool.name = "tip";
    tool.device = "hand";
    tool.radius = 2 * spacing;
    scene.tools = {tool};
  }

  const Integrator integrator = integrator_of(scene, dice);
  const bool implicit = integrator == Integrator::backward_euler;
  stress.step_ratio = implicit ? dice.decades(1, 100) : dice.between(0.1, 1.0);
  const int steps_per_frame = 1 + dice.pick(4);
  stress.frames = (implicit ? 60 : 240) / steps_per_frame;
  // Implicit steps too are measured in explicit ones.
  scene.physics->integrator = implicit ? Integrator::symplectic_euler : integrator;
  scene.physics->frame_Hz = 1e12;  // any step fits into a frame: only the stable one is asked for
  const double stable = physics::World(scene).stable_step_seconds();
  scene.physics->integrator = integrator;
  const double step = stress.step_ratio * (std::isfinite(stable) ? stable : 1e-3);
  scene.physics->step = step;
  scene.physics->frame_Hz = 1 / (steps_per_frame * step);
  return stress;
}

void set_start(const StressScene& stress, physics::World& world) {
  Dice dice(stress.seed + 77);
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    physics::BodyModel& body = world.body(b);
    const physics::Lattice& lattice = body.body().lattice;
    const double L = lattice.rest_length[0];
    const Vec3 middle = lattice.rest_position(lattice.masses[lattice.masses.size() / 2]);
    for (const physics::Index cell : lattice.masses) {
      const Vec3 p = lattice.rest_position(cell);
      if (stress.start == Start::shaken) body.place(cell, Vec3::Zero(), dice.within(stress.amount));
      if (stress.start == Start::scattered) body.place(cell, dice.within(stress.amount * L), Vec3::Zero());
      if (stress.start == Start::inverted) body.place(cell, Vec3(0, 0, -2 * (p - middle).z()), Vec3::Zero());
      if (stress.start != Start::zero_length || !dice.chance(0.5 * stress.amount)) continue;
      const auto d = static_cast<std::size_t>(dice.pick(2 * lattice.n_half));  // onto where a neighbour is
      if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) != 0)
        body.place(cell, lattice.rest_vector[d], Vec3::Zero());
    }
  }
}

std::optional<ToolState> tool_at(const StressScene& stress, const physics::World& world, int frame) {
  if (stress.tool_force <= 0) return std::nullopt;
  Dice dice(stress.seed + 99);
  const Vec3 along = dice.within(1).normalized(), push = dice.within(1).normalized();
  const physics::BodyModel& body = world.body(0);
  const auto& masses = body.body().lattice.masses;
  const Vec3 middle = body.body().lattice.rest_position(masses[masses.size() / 2]);
  ToolState state;
  state.tick = static_cast<std::uint64_t>(frame) + 1;
  const Vec3 tip = middle + (frame - stress.frames / 2) * world.frame_seconds() * stress.tool_speed * along;
  state.p_WT = state.proxy = array(tip);
  state.v_WT = array(Vec3(stress.tool_speed * along));
  state.force_on_hand = array(Vec3(stress.tool_force * push));
  state.engaged = 1;
  return state;
}

std::string describe(const StressScene& s) {
  const Scene& scene = s.scene;
  const MaterialSpec& m = scene.materials[0];
  return fmt::format(
      "{} {} E {:.2g} Pa (other {:.2g}) rho {:.2g} (other {:.2g}) spacing {:.2g} m {} regions {} bodies {}{} "
      "viscosity "
      "{:.2g} Pa s start {} {:.2g} gravity {:.3g} m/s2 floor {} tool {:.2g} N {:.2g} m/s step {:.3g} of "
      "stable",
      name_of(scene.physics->integrator), name_of(scene.physics->precision), *m.modulus,
      *scene.materials[1].modulus, *m.density, *scene.materials[1].density, *scene.bodies[0].spacing,
      scene.bodies[0].regions.size(), scene.bodies.size(),
      scene.bodies[0].model == ElementModel::fem
          ? fmt::format(
                " elements nu {:.3f}{}{} {}{}{}", m.poisson_ratio,
                m.yield_ratio ? fmt::format(" yield {:.4g} slope {:.3g}", *m.yield_ratio, m.k2_ratio) : "",
                m.break_ratio ? fmt::format(" break {:.4g} for {:.3g} J/m2", *m.break_ratio,
                                            m.fracture_energy.value_or(0))
                              : "",
                scene.bodies[0].hourglass == HourglassKind::physical ? "physical" : "isotropic",
                m.law == TissueLaw::green ? " green" : "", m.relaxation.empty() ? "" : " relaxing")
      : m.yield_ratio ? fmt::format(" yield {:.4g} break {:.4g}", *m.yield_ratio, *m.break_ratio)
                      : " elastic",
      scene.physics->sleep ? " sleep" : "", m.viscosity_bulk.value_or(0),
      start_names[static_cast<int>(s.start)], s.amount, scene.gravity.norm(), scene.floor.has_value(),
      s.tool_force, s.tool_speed, s.step_ratio);
}

}  // namespace palpate::bench
