// [material.NAME]: a tissue (per volume) or the papers' constants (per mass and element).
#include <fmt/format.h>

#include <algorithm>

#include "common/math/units.h"
#include "common/scene/material_spec.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

/// Complains if several of a group of keys are there, or if none is and one must be.
void check_group(TableReader& reader, const std::vector<std::string>& group, bool one_needed) {
  std::vector<std::string> given;
  for (const auto& key : group)
    if (reader.has(key)) given.push_back(key);
  if (given.size() > 1)
    reader.complain(given.back(), fmt::format("{} {} are given in {}; keep one of them",
                                              given.size() == 2 ? "both" : "all of",
                                              quoted_list(given, "and"), reader.title()));
  else if (one_needed && given.empty())
    reader.complain_lack(quoted_list(group), "give exactly one of them");
}

/// modulus_by_intensity = [[intensity, kPa], ...]
void read_modulus_by_intensity(TableReader& reader, MaterialSpec& spec) {
  constexpr std::string_view key = "modulus_by_intensity";
  constexpr std::string_view form = "a list of [intensity, kPa], such as [[100, 2], [400, 20]]";
  const toml::array* list = reader.read_array(key, form);
  if (list == nullptr) return;
  spec.modulus = 1;  // any: what is wrong with the list is said once
  if (list->size() < 2 || list->size() > most_modulus_points)
    return reader.complain(key, fmt::format("{} points of \"{}\" in {}; write 2 to {}", list->size(), key,
                                            reader.title(), most_modulus_points));
  for (const toml::node& entry : *list) {
    const auto pair = numbers_of(entry, 2);
    if (!pair) return reader.complain_value(key, entry, form);
    const ModulusPoint point{.intensity = (*pair)[0], .modulus = Pa_from_kPa((*pair)[1])};
    if (!(point.modulus > 0))
      return reader.complain_value(key, *entry.as_array()->get(1), "a modulus above 0 kPa");
    if (!spec.modulus_by_intensity.empty() && !(point.intensity > spec.modulus_by_intensity.back().intensity))
      return reader.complain_value(key, *entry.as_array()->get(0),
                                   "an intensity above that of the point before");
    spec.modulus_by_intensity.push_back(point);
  }
  const auto [least, most] = std::ranges::minmax(spec.modulus_by_intensity, {}, &ModulusPoint::modulus);
  if (most.modulus > largest_modulus_contrast * least.modulus)
    reader.complain(
        key, fmt::format("\"{}\" in {} goes from {} to {} kPa; at most {:.0e} times", key, reader.title(),
                         1e-3 * least.modulus, 1e-3 * most.modulus, largest_modulus_contrast));
  spec.modulus = least.modulus;
}

void read_stiffness(TableReader& reader, MaterialSpec& spec) {
  spec.k1 = reader.read_number("k1_N_per_m", positive);
  if (const auto modulus_kPa = reader.read_number("modulus_kPa", positive))
    spec.modulus = Pa_from_kPa(*modulus_kPa);
  else if (reader.has("modulus_kPa"))
    spec.modulus = 1;  // Why: it was refused; that there is none would be a second complaint, and untrue
  spec.lambda = reader.read_number("lambda_N", positive);
  read_modulus_by_intensity(reader, spec);
  check_group(reader, {"k1_N_per_m", "modulus_kPa", "lambda_N", "modulus_by_intensity"}, true);
  if (const auto word = reader.read_word("law", {"neo_hookean", "green"}))
    spec.law = static_cast<TissueLaw>(*word);
  set_if(spec.poisson_ratio, reader.read_number("poisson_ratio", {.lo = 0, .hi = 0.495}));
  set_if(spec.k2_ratio, reader.read_number("k2_ratio", {.lo = 0, .hi = 1}));
}

void read_damping(TableReader& reader, MaterialSpec& spec) {
  spec.viscosity = reader.read_number("viscosity_N_s_per_m", not_negative);
  spec.viscosity_bulk = reader.read_number("viscosity_Pa_s", not_negative);
  check_group(reader, {"viscosity_N_s_per_m", "viscosity_Pa_s"}, false);
  if (const auto word = reader.read_word("damper", {"axial", "relative", "drag"}))
    spec.damper = static_cast<Damper>(*word);
  if (reader.has("damper") && !reader.has("viscosity_N_s_per_m") && !reader.has("viscosity_Pa_s"))
    reader.complain("damper", fmt::format("\"damper\" in {} has no constant; give viscosity_N_s_per_m or "
                                          "viscosity_Pa_s too",
                                          reader.title()));
  set_if(spec.drag, reader.read_number("drag_N_s_per_m", not_negative));
}

/// relaxation = [[share, time in s], ...]
void read_relaxation(TableReader& reader, MaterialSpec& spec) {
  constexpr std::string_view form = "a list of [share, time_s], such as [[0.3, 0.05], [0.2, 1]]";
  const toml::array* list = reader.read_array("relaxation", form);
  if (list == nullptr) return;
  if (list->size() > most_relaxation_terms)
    return reader.complain("relaxation", fmt::format("{} terms of \"relaxation\" in {}; at most {}",
                                                     list->size(), reader.title(), most_relaxation_terms));
  double shares = 0;
  for (const toml::node& entry : *list) {
    const auto pair = numbers_of(entry, 2);
    if (!pair) return reader.complain_value("relaxation", entry, form);
    const RelaxationSpec term{.share = (*pair)[0], .time = (*pair)[1]};
    if (!(term.share > 0 && term.share < 1))
      return reader.complain_value("relaxation", *entry.as_array()->get(0),
                                   "a share of the modulus, above 0 and below 1");
    if (!(term.time >= shortest_relaxation && term.time <= longest_relaxation))
      return reader.complain_value(
          "relaxation", *entry.as_array()->get(1),
          fmt::format("a time from {} to {:.0e} s", shortest_relaxation, longest_relaxation));
    shares += term.share;
    spec.relaxation.push_back(term);
  }
  if (shares > most_relaxing_share)
    reader.complain(
        "relaxation",
        fmt::format("shares of \"relaxation\" in {} sum up to {}; at most {} of the modulus may fade",
                    reader.title(), shares, most_relaxing_share));
}

/// Is it the material of finite elements, and of nothing else? Looks ahead, at bodies and tools that are not read yet.
bool is_of_elements(const toml::table& scene, std::string_view material) {
  const auto names = [material](const toml::node& node) {
    return node.is_table() && (*node.as_table())["material"].value_or(std::string_view()) == material;
  };
  bool any = false;
  for (const std::string_view kind : {"body", "tool"}) {
    const toml::array* list = scene[kind].as_array();
    if (list == nullptr) continue;
    for (const toml::node& node : *list) {
      const toml::table* table = node.as_table();
      if (table == nullptr) continue;
      const toml::array* regions = (*table)["regions"].as_array();
      if (!names(node) && (regions == nullptr || std::none_of(regions->begin(), regions->end(), names)))
        continue;
      const bool is_mesh = (*table)["shape"].value_or(std::string_view()) == "mesh";
      if (!is_mesh && (*table)["model"].value_or(std::string_view()) != "fem") return false;
      any = true;
    }
  }
  return any;
}

/// @param of_elements  of finite elements, which may break without yielding
void read_plasticity(TableReader& reader, MaterialSpec& spec, bool of_elements) {
  const Range above_one{.lo = 1, .without_lo = true};
  spec.yield_ratio = reader.read_number("yield_ratio", above_one);
  spec.break_ratio = reader.read_number("break_ratio", above_one);
  spec.fracture_energy = reader.read_number("fracture_energy_J_per_m2", positive);
  spec.cut_toughness = reader.read_number("cut_toughness_J_per_m2", positive);
  set_if(spec.puncture_ratio, reader.read_number("puncture_ratio", {.lo = 1, .hi = most_puncture_ratio}));
  if (reader.has("puncture_ratio") && !reader.has("cut_toughness_J_per_m2"))
    reader.complain("puncture_ratio",
                    fmt::format("\"puncture_ratio\" stands alone in {}; give cut_toughness_J_per_m2 too, "
                                "which it multiplies",
                                reader.title()));
  if (reader.has("fracture_energy_J_per_m2") && !reader.has("break_ratio"))
    reader.complain("fracture_energy_J_per_m2",
                    fmt::format("\"fracture_energy_J_per_m2\" stands alone in {}; give break_ratio too, at "
                                "which tissue begins to break",
                                reader.title()));
  const bool yields = reader.has("yield_ratio");
  if (yields != reader.has("break_ratio") && !of_elements)
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

MaterialSpec read_material(TableReader& reader, bool of_elements) {
  MaterialSpec spec;
  spec.place = reader.place();
  if (const auto mass_g = reader.read_number("mass_g", positive)) spec.mass = kg_from_g(*mass_g);
  spec.density = reader.read_number("density_kg_per_m3", positive);
  check_group(reader, {"mass_g", "density_kg_per_m3"}, true);
  read_stiffness(reader, spec);
  read_damping(reader, spec);
  read_relaxation(reader, spec);
  read_plasticity(reader, spec, of_elements);
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_materials(TableReader& root, ReadContext& context) {
  for (const auto& [name, table] : named_tables(root, "material")) {
    TableReader reader(*table, fmt::format("[material.{}]", name), context.complaints);
    auto spec = read_material(reader, is_of_elements(root.table(), name));
    spec.name = name;
    // What is stated and has been taken: else there is a complaint already.
    if ((*table)["poisson_ratio"].value<double>() == spec.poisson_ratio)
      context.with_poisson_ratio.push_back(name);
    context.scene.materials.push_back(std::move(spec));
  }
}

}  // namespace palpate
