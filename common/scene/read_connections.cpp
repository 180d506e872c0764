// [[connection]]
#include <fmt/format.h>

#include <algorithm>

#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

constexpr std::size_t most_connections = 64;

ConnectionSpec read_connection(TableReader& reader, ReadContext& context) {
  ConnectionSpec spec;
  spec.place = reader.place();
  reader.require("name", "give each connection a name of its own");
  reader.require("from", "name the [[body]] whose surface the strands begin at");
  reader.require("to", "name the [[body]] that they end at");
  reader.require("within_mm", "give how far apart the surfaces are at most, where they are joined");
  reader.require("modulus_kPa", "give the modulus along the strands");
  set_if(spec.name, reader.read_name("name"));
  refuse_known_name(reader, spec.name, names_of(context.scene.connections));
  const auto bodies = names_of(context.scene.bodies);
  for (const auto& [key, name] : {std::pair("from", &spec.from), std::pair("to", &spec.to)})
    if (const auto body = reader.read_text(key)) {
      *name = *body;
      refuse_unknown_reference(reader, key, *body, bodies);
    }
  if (!spec.from.empty() && spec.from == spec.to)
    reader.complain("to", fmt::format("{} joins \"{}\" to itself; name two bodies", reader.title(), spec.to));
  set_if(spec.within, reader.read_length_mm("within_mm"));
  if (const auto kPa = reader.read_number("modulus_kPa", {.lo = 0, .hi = 1e6, .without_lo = true}))
    spec.modulus = Pa_from_kPa(*kPa);
  set_if(spec.viscosity, reader.read_number("viscosity_Pa_s", {.lo = 0, .hi = 1e6}));
  set_if(spec.toughness, reader.read_number("toughness_J_per_m2", not_negative));
  spec.cut_toughness = reader.read_number("cut_toughness_J_per_m2", positive);
  if (context.scene.physics->integrator == Integrator::backward_euler)
    reader.complain("name",
                    fmt::format("{} is not among what \"backward_euler\" solves for; leave \"integrator\" in "
                                "[physics] out",
                                reader.title()));
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_connections(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "connection", most_connections)) {
    TableReader reader(*table, list_title(*table, "connection"), context.complaints);
    context.scene.connections.push_back(read_connection(reader, context));
  }
}

}  // namespace palpate
