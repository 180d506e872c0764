// `model`, `hourglass`, `elements`, `border_cells` and `start` of a body: springs or finite elements.
#include <fmt/format.h>

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

/// What of a material finite elements cannot follow, and what would be right; empty: nothing.
std::string hindrance(const MaterialSpec& material, const BodySpec& spec) {
  if (!material.modulus) return "has no modulus_kPa; give it in place of k1_N_per_m or lambda_N";
  if (!material.density) return "has no density_kg_per_m3; give it in place of mass_g";
  if (material.yield_ratio && material.k2_ratio >= 1)
    return "yields with k2_ratio = 1, which changes nothing; give a k2_ratio below 1, 0 for flow under "
           "constant "
           "stress";
  if (material.yield_ratio && material.law == TissueLaw::green)
    return "yields beside law = \"green\"; only \"neo_hookean\" does";
  if (material.yield_ratio && !material.relaxation.empty())
    return "yields and relaxes; leave yield_ratio or relaxation out";
  if (material.break_ratio && material.law == TissueLaw::green)
    return "breaks beside law = \"green\"; only \"neo_hookean\" does";
  if (material.break_ratio && !material.relaxation.empty())
    return "breaks and relaxes; leave break_ratio or relaxation out";
  if (material.break_ratio && spec.border.cells == BorderCells::filled)
    return "breaks, and border_cells = \"filled\" has cells that nobody sees; leave one of them out";
  if (material.viscosity) return "has viscosity_N_s_per_m, which is of one spring; give viscosity_Pa_s";
  if (material.drag > 0) return "has drag_N_s_per_m, which is of the papers' masses; give viscosity_Pa_s";
  if (material.damper != Damper::axial) return "has a damper of springs; leave \"damper\" out";
  if (material.law == TissueLaw::green && !material.relaxation.empty())
    return "relaxes beside law = \"green\"; only \"neo_hookean\" does";
  if (!material.modulus_by_intensity.empty() && !std::holds_alternative<VolumeShape>(spec.shape))
    return "has modulus_by_intensity, but the body is no image; give modulus_kPa";
  return {};
}

void refuse_materials(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  for (const MaterialSpec& material : context.scene.materials) {
    if (!has_material(spec, material.name)) continue;
    if (const std::string what = hindrance(material, spec); !what.empty())
      reader.complain("model", fmt::format("model = \"fem\" in {}, but [material.{}] {}", reader.title(),
                                           material.name, what));
  }
}

/// What a mesh has of its own, and what of a scene it cannot follow.
void read_tetrahedra(TableReader& reader, const ReadContext& context, BodySpec& spec) {
  if (reader.has("model") && spec.model == ElementModel::springs)
    reader.complain("model",
                    "a mesh is of finite elements, or a surface of springs; write model = \"fem\" or "
                    "\"surface\", or leave "
                    "\"model\" out");
  spec.model = ElementModel::fem;
  if (const auto word = reader.read_word("elements", {"plain", "nodal_pressure", "second_order"}))
    spec.tet_elements = static_cast<TetElements>(*word);
  if (context.scene.physics->integrator != Integrator::symplectic_euler)
    reader.complain("shape",
                    "a mesh is stepped by \"symplectic_euler\" only; leave \"integrator\" in [physics] "
                    "out");
  for (const MaterialSpec& material : context.scene.materials) {
    if (!has_material(spec, material.name)) continue;
    const std::string beyond = beyond_elastic(material);
    const std::string what = beyond.empty()
                                 ? hindrance(material, spec)
                                 : beyond +
                                       ", which tetrahedra do not follow; leave that out, or take a shape on "
                                       "lattice = \"voxel\"";
    if (!what.empty())
      reader.complain("material",
                      fmt::format("{} is a mesh, but [material.{}] {}", reader.title(), material.name, what));
  }
}

/// The hourglass modes of the isotropic kind neither fade nor yield, and thin parts would stay stiff.
void refuse_isotropic(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  if (spec.hourglass != HourglassKind::isotropic) return;
  for (const MaterialSpec& material : context.scene.materials) {
    const bool relaxes = material.name == spec.material && !material.relaxation.empty();
    if (relaxes || (material.yield_ratio && has_material(spec, material.name)))
      reader.complain("hourglass",
                      fmt::format("hourglass = \"isotropic\" in {}, but [material.{}] {}; write "
                                  "\"physical\"",
                                  reader.title(), material.name, relaxes ? "relaxes" : "yields"));
  }
}

void refuse_implicit(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  if (context.scene.physics->integrator != Integrator::backward_euler) return;
  for (const MaterialSpec& material : context.scene.materials) {
    const std::string what = beyond_elastic(material);
    if (has_material(spec, material.name) && !what.empty())
      reader.complain("material",
                      fmt::format("[material.{}] of {} {}, which \"backward_euler\" does not follow; "
                                  "leave \"integrator\" in [physics] out, or that",
                                  material.name, reader.title(), what));
  }
}

/// What of a material springs cannot follow; empty: nothing.
std::string beyond_springs(const MaterialSpec& material, const ReadContext& context) {
  if (!material.relaxation.empty()) return "a relaxation";
  if (!material.modulus_by_intensity.empty()) return "modulus_by_intensity";
  if (material.law != TissueLaw::neo_hookean) return "a law";
  if (material.fracture_energy) return "fracture_energy_J_per_m2";
  if (std::ranges::count(context.with_poisson_ratio, material.name) > 0) return "poisson_ratio";
  return {};
}

/// What is balanced creeps on, or flows.
void refuse_balanced(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  if (spec.start != StartKind::balanced) return;
  for (const MaterialSpec& material : context.scene.materials) {
    if (material.yield_ratio && has_material(spec, material.name))
      reader.complain(
          "start", fmt::format("start = \"balanced\" in {}, but [material.{}] yields; the balance is found "
                               "of what does not; leave \"start\" or yield_ratio out",
                               reader.title(), material.name));
    if (material.name != spec.material) continue;
    if (!material.relaxation.empty())
      reader.complain("start",
                      fmt::format("start = \"balanced\" in {}, but [material.{}] relaxes and would sink "
                                  "on; leave \"start\" or the relaxation out",
                                  reader.title(), material.name));
    if (material.law == TissueLaw::green)
      reader.complain("start",
                      fmt::format("start = \"balanced\" in {}, but [material.{}] has law = \"green\"; the "
                                  "balance is found of \"neo_hookean\" only",
                                  reader.title(), material.name));
  }
}

/// Shares of cells are of bodies whose cells are more than a wall of so many layers, and what breaks has whole ones.
void refuse_filled(TableReader& reader, const BodySpec& spec) {
  if (spec.border.cells != BorderCells::filled) return;
  const auto* tube = std::get_if<TubeShape>(&spec.shape);
  if (tube != nullptr && tube->wall_layers)
    reader.complain("border_cells",
                    "border_cells = \"filled\" beside wall_layers, which counts whole cells; "
                    "give inner_radius_mm");
  if (std::holds_alternative<KnifeShape>(spec.shape) || std::holds_alternative<NeedleShape>(spec.shape))
    reader.complain("border_cells", "border_cells = \"filled\" is of tissue; leave it out of a tool");
}

/// What a body that is awake in parts cannot do: what rests is to be put back where it rests.
void refuse_awake(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  const auto* image = std::get_if<VolumeShape>(&spec.shape);
  if (image == nullptr || !image->deformable.awake) return;
  const auto refuse = [&](const std::string& what) {
    reader.complain("deformable", fmt::format("\"awake_mm\" in {}, but {}", reader.title(), what));
  };
  if (spec.model != ElementModel::fem) return refuse("it is of springs; write model = \"fem\"");
  for (const MaterialSpec& material : context.scene.materials)
    if (const std::string what = beyond_elastic(material); !what.empty() && has_material(spec, material.name))
      refuse(fmt::format("[material.{}] {}; leave one of them out", material.name, what));
  if (context.scene.physics->integrator == Integrator::backward_euler)
    refuse("\"backward_euler\" solves for all of it; leave \"integrator\" in [physics] out");
  if (!context.scene.physics->sleep)
    refuse("what is not near to a tool sleeps; leave \"sleep\" in [physics] out");
  if (spec.start == StartKind::balanced) refuse("its weight is balanced as it stands; leave \"start\" out");
  for (const char* key : {"handle", "velocity_m_per_s"})
    if (reader.has(key)) refuse(fmt::format("it stands where it is; leave \"{}\" out", key));
}

void refuse_springs(TableReader& reader, const ReadContext& context, const BodySpec& spec) {
  for (const MaterialSpec& material : context.scene.materials) {
    if (!has_material(spec, material.name)) continue;
    if (const std::string what = beyond_springs(material, context); !what.empty())
      reader.complain("material", fmt::format("{} is of springs, but [material.{}] has {}, which only finite "
                                              "elements follow; write model = \"fem\", or leave it out",
                                              reader.title(), material.name, what));
  }
}

}  // namespace

void read_elements(TableReader& reader, ReadContext& context, BodySpec& spec) {
  if (const auto word = reader.read_word("model", {"springs", "fem", "surface"}))
    spec.model = static_cast<ElementModel>(*word);
  if (const auto word = reader.read_word("hourglass", {"physical", "isotropic"}))
    spec.hourglass = static_cast<HourglassKind>(*word);
  if (const auto word = reader.read_word("start", {"rest", "balanced"}))
    spec.start = static_cast<StartKind>(*word);
  if (const auto word = reader.read_word("border_cells", {"whole", "filled"}))
    spec.border.cells = static_cast<BorderCells>(*word);
  refuse_awake(reader, context, spec);
  if (spec.model == ElementModel::surface) return read_membrane(reader, context, spec);
  refuse_membrane_keys(reader);
  if (std::holds_alternative<MeshShape>(spec.shape)) return read_tetrahedra(reader, context, spec);
  if (reader.has("elements")) {
    reader.allow({"elements"});
    reader.complain("elements", "\"elements\" is of a mesh; leave it out");
  }
  const bool fem = spec.model == ElementModel::fem;
  if (!fem && reader.has("hourglass"))
    reader.complain("hourglass",
                    "\"hourglass\" is of finite elements; write model = \"fem\", or leave it out");
  if (!fem && spec.border.cells == BorderCells::filled)
    reader.complain("border_cells",
                    "\"filled\" is of finite elements; write model = \"fem\", or leave \"border_cells\" out");
  if (!fem && spec.start == StartKind::balanced)
    reader.complain("start",
                    "\"balanced\" is of finite elements; write model = \"fem\", or leave \"start\" out");
  if (!fem) return refuse_springs(reader, context, spec);
  if (spec.lattice != LatticeKind::voxel)
    reader.complain(
        "model", fmt::format("model = \"fem\" in {} needs cells; write lattice = \"voxel\"", reader.title()));
  if (context.scene.physics->integrator == Integrator::velocity_verlet)
    reader.complain(
        "model", fmt::format("model = \"fem\" in {} is stepped by symplectic Euler or backward Euler; leave "
                             "\"integrator\" in [physics] out, or write \"backward_euler\"",
                             reader.title()));
  refuse_materials(reader, context, spec);
  refuse_isotropic(reader, context, spec);
  refuse_implicit(reader, context, spec);
  refuse_balanced(reader, context, spec);
  refuse_filled(reader, spec);
}

}  // namespace palpate
