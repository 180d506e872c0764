// [material.NAME]: a tissue (per volume) or the papers' constants (per mass and element).
#include <fmt/format.h>

#include "common/math/units.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

/// Complains if both of a pair of keys are there, or if none is and one must be.
void check_pair(TableReader& reader, const std::string& a, const std::string& b, bool one_needed) {
  if (reader.has(a) && reader.has(b))
    reader.complain(
        b, fmt::format("both \"{}\" and \"{}\" are given in {}; keep one of them", a, b, reader.title()));
  else if (one_needed && !reader.has(a) && !reader.has(b))
    reader.complain_lack(fmt::format("\"{}\" or \"{}\"", a, b), "give exactly one of them");
}

void read_plasticity(TableReader& reader, MaterialSpec& spec) {
  const Range above_one{.lo = 1, .without_lo = true};
  spec.yield_ratio = reader.read_number("yield_ratio", above_one);
  spec.break_ratio = reader.read_number("break_ratio", above_one);
  const bool yields = reader.has("yield_ratio");
  if (yields != reader.has("break_ratio"))
    reader.complain(
        yields ? "yield_ratio" : "break_ratio",
        fmt::format("\"{}\" stands alone in {}; give yield_ratio and break_ratio, or neither for an "
                    "elastic material",
                    yields ? "yield_ratio" : "break_ratio", reader.title()));
  if (spec.yield_ratio && spec.break_ratio && *spec.break_ratio <= *spec.yield_ratio)
    reader.complain("break_ratio",
                    fmt::format("\"break_ratio\" in {} is {}; write a number above yield_ratio = {}",
                                reader.title(), *spec.break_ratio, *spec.yield_ratio));
}

MaterialSpec read_material(TableReader& reader) {
  MaterialSpec spec;
  spec.place = reader.place();
  if (const auto mass_g = reader.read_number("mass_g", positive)) spec.mass = kg_from_g(*mass_g);
  spec.density = reader.read_number("density_kg_per_m3", positive);
  check_pair(reader, "mass_g", "density_kg_per_m3", true);
  spec.k1 = reader.read_number("k1_N_per_m", positive);
  if (const auto modulus_kPa = reader.read_number("modulus_kPa", positive))
    spec.modulus = Pa_from_kPa(*modulus_kPa);
  check_pair(reader, "k1_N_per_m", "modulus_kPa", true);
  set_if(spec.k2_ratio, reader.read_number("k2_ratio", {.lo = 0, .hi = 1}));
  spec.viscosity = reader.read_number("viscosity_N_s_per_m", not_negative);
  spec.viscosity_bulk = reader.read_number("viscosity_Pa_s", not_negative);
  check_pair(reader, "viscosity_N_s_per_m", "viscosity_Pa_s", false);
  read_plasticity(reader, spec);
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_materials(TableReader& root, ReadContext& context) {
  for (const auto& [name, table] : named_tables(root, "material")) {
    TableReader reader(*table, fmt::format("[material.{}]", name), context.complaints);
    auto spec = read_material(reader);
    spec.name = name;
    context.scene.materials.push_back(std::move(spec));
  }
}

}  // namespace palpate
