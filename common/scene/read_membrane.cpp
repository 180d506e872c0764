// A body whose model is "surface": springs on the edges of a mesh's outer triangles.
#include <fmt/format.h>

#include <algorithm>

#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

/// What of a material such springs cannot follow, and what would be right; empty: nothing.
std::string hindrance(const MaterialSpec& material, const ReadContext& context) {
  if (!material.modulus || !material.modulus_by_intensity.empty())
    return "has no modulus_kPa; give it in place of its other stiffness";
  if (!material.density) return "has no density_kg_per_m3; give it in place of mass_g";
  if (material.yield_ratio || material.break_ratio)
    return "yields or breaks; leave yield_ratio and break_ratio out";
  if (material.viscosity) return "has viscosity_N_s_per_m, which is of one spring; give viscosity_Pa_s";
  if (material.damper != Damper::axial) return "has another damper than \"axial\"; leave \"damper\" out";
  if (!material.relaxation.empty()) return "relaxes; leave \"relaxation\" out";
  if (material.law != TissueLaw::neo_hookean)
    return "has a law, which is of finite elements; leave \"law\" out";
  if (std::ranges::count(context.with_poisson_ratio, material.name) > 0)
    return "has poisson_ratio, and springs in a plane have 1/3; leave it out";
  return {};
}

constexpr const char* membrane_keys[] = {"thickness_mm", "pressure_kPa", "content_modulus_kPa"};

}  // namespace

void refuse_membrane_keys(TableReader& reader) {
  for (const char* key : membrane_keys) {
    if (!reader.has(key)) continue;
    reader.allow({key});
    reader.complain(key, fmt::format("\"{}\" is of a mesh with model = \"surface\"; leave it out", key));
  }
}

void read_membrane(TableReader& reader, const ReadContext& context, BodySpec& spec) {
  if (!std::holds_alternative<MeshShape>(spec.shape)) {
    reader.complain("model",
                    fmt::format("model = \"surface\" in {} needs shape = \"mesh\", whose outer triangles "
                                "carry its springs",
                                reader.title()));
    return reader.allow({membrane_keys[0], membrane_keys[1], membrane_keys[2]});
  }
  spec.membrane.emplace();
  reader.require("thickness_mm", "give how thick the wall of the surface is");
  set_if(spec.membrane->thickness, reader.read_length_mm("thickness_mm"));
  if (const auto kPa = reader.read_number("pressure_kPa", {.lo = -1000, .hi = 1000}))
    spec.membrane->pressure = Pa_from_kPa(*kPa);
  if (const auto kPa = reader.read_number("content_modulus_kPa", {.lo = 0, .hi = 1e6}))
    spec.membrane->content_modulus = Pa_from_kPa(*kPa);
  if (context.scene.physics->integrator != Integrator::symplectic_euler)
    reader.complain("shape",
                    "a mesh is stepped by \"symplectic_euler\" only; leave \"integrator\" in [physics] out");
  if (spec.start != StartKind::rest)
    reader.complain("start", "\"balanced\" is of finite elements; leave \"start\" out of a surface");
  for (const char* key : {"elements", "regions"}) {
    if (!reader.has(key)) continue;
    reader.allow({key});
    reader.complain(key, fmt::format("\"{}\" is of tetrahedra, and a surface has none; leave it out", key));
  }
  for (const MaterialSpec& material : context.scene.materials) {
    if (material.name != spec.material) continue;
    if (const std::string what = hindrance(material, context); !what.empty())
      reader.complain("model", fmt::format("model = \"surface\" in {}, but [material.{}] {}", reader.title(),
                                           material.name, what));
  }
}

}  // namespace palpate
