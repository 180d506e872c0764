// [[tool]]
#include <fmt/format.h>

#include <algorithm>

#include "common/message/messages.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

void read_tool_shape(TableReader& reader) {
  const std::vector<std::string> later = {"stick", "knife", "needle"};
  const auto* value = reader.find("shape");
  if (value == nullptr || value->value_or(std::string()) == "point") return;
  const auto word = value->value_or(std::string());
  if (std::count(later.begin(), later.end(), word) > 0)
    reader.complain("shape",
                    fmt::format("tool shape \"{}\" is not built by this version; it builds \"point\"", word));
  else
    reader.complain_value("shape", *value, "\"point\"");
}

ToolSpec read_tool(TableReader& reader, ReadContext& context) {
  ToolSpec spec;
  spec.place = reader.place();
  reader.require("name", "give each tool a name of its own");
  set_if(spec.name, reader.read_name("name"));
  refuse_known_name(reader, spec.name, names_of(context.scene.tools));
  read_tool_shape(reader);
  reader.require("device", "name a [device.NAME] of this scene");
  if (const auto device = reader.read_text("device")) {
    spec.device = *device;
    refuse_unknown_reference(reader, "device", *device, names_of(context.scene.devices));
  }
  set_if(spec.set_point, reader.read_vector_mm("set_point_mm"));
  set_if(spec.radius, reader.read_length_mm("radius_mm"));
  set_if(spec.stiffness, reader.read_number("stiffness_N_per_m", positive));
  set_if(spec.damping, reader.read_number("damping_N_s_per_m", not_negative));
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_tools(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "tool", max_tools)) {
    TableReader reader(*table, list_title(*table, "tool"), context.complaints);
    context.scene.tools.push_back(read_tool(reader, context));
  }
}

}  // namespace palpate
