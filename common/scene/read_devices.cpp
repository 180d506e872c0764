// [device.NAME]: a haptic device, or the simulated hand.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "common/math/units.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

void read_rotation(TableReader& reader, DeviceSpec& spec) {
  constexpr double tolerance = 1e-6;
  constexpr std::string_view form = "three rows [[a, b, c], [d, e, f], [g, h, i]]";
  const auto* rows = reader.read_array("rotation", form);
  if (rows == nullptr) return;
  bool right = rows->size() == 3;
  Eigen::Matrix3d R;
  for (Eigen::Index i = 0; right && i < 3; ++i) {
    const auto row = numbers_of(*rows->get(static_cast<std::size_t>(i)), 3);
    right = row.has_value();
    if (right) R.row(i) << (*row)[0], (*row)[1], (*row)[2];
  }
  if (!right) {
    reader.complain_value("rotation", *rows, form);
    return;
  }
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= tolerance))
    reader.complain("rotation",
                    fmt::format("\"rotation\" in {} is not orthonormal; rows must have length 1 and stand "
                                "square to each other within {}",
                                reader.title(), tolerance));
  else if (R.determinant() < 0)
    reader.complain("rotation",
                    fmt::format("\"rotation\" in {} mirrors; its determinant must be +1", reader.title()));
  else
    spec.rotation = R;
}

void read_waypoints(TableReader& reader, DeviceSpec& spec) {
  constexpr std::string_view form = "[t_s, x_mm, y_mm, z_mm]";
  const auto* list = reader.read_array("waypoints", fmt::format("a list of {}", form));
  if (list == nullptr) return;
  if (list->size() < 2)
    reader.complain("waypoints",
                    fmt::format("the path is too short; write two waypoints or more, each {}", form));
  bool in_order = true;
  for (const auto& item : *list) {
    const auto n = numbers_of(item, 4);
    if (!n) {
      reader.complain_value("waypoints", item, form);
      continue;
    }
    const double t = (*n)[0];
    const double earliest = spec.waypoints.empty() ? 0 : spec.waypoints.back().t;
    const bool late_enough = spec.waypoints.empty() ? t >= 0 : t > earliest;
    if (!late_enough && in_order) {
      reader.complain_at(
          place_of(item.source()),
          spec.waypoints.empty()
              ? fmt::format("the path starts at {} s; times start at 0 or later", t)
              : fmt::format("waypoint at {} s follows one at {} s; times must grow", t, earliest));
      in_order = false;  // say it once
    }
    spec.waypoints.push_back({t, Vec3((*n)[1], (*n)[2], (*n)[3]) * m_from_mm(1.0)});
  }
}

/// Keys that only the driver knows, as text.
void read_options(TableReader& reader, DeviceSpec& spec) {
  for (const auto& key : reader.left_over()) {
    const auto& value = *reader.find(key);
    if (const auto* text = value.as_string())
      spec.options.emplace_back(key, text->get());
    else if (value.is_number() || value.is_boolean())
      spec.options.emplace_back(key, described(value));
    else
      reader.complain_value(key, value, "a text, a number, true or false");
  }
}

DeviceSpec read_device(TableReader& reader) {
  DeviceSpec spec;
  spec.place = reader.place();
  reader.require("driver", "write \"simulated\" or the name of a driver");
  if (const auto driver = reader.read_text("driver")) {
    spec.driver = *driver;
    if (driver->empty())
      reader.complain("driver", "\"driver\" is empty; write \"simulated\" or the name of a driver");
  }
  set_if(spec.rate_Hz, reader.read_number("rate_Hz", {.lo = 20, .hi = 20000}));
  set_if(spec.force_limit, reader.read_number("force_limit_N", positive));
  read_rotation(reader, spec);
  set_if(spec.scale, reader.read_number("scale", positive));
  set_if(spec.force_scale, reader.read_number("force_scale", positive));
  set_if(spec.offset, reader.read_vector_mm("offset_mm"));
  read_waypoints(reader, spec);
  if (const auto hand = reader.read_word("hand", {"rigid", "arm", "pinch", "firm"}))
    spec.hand = static_cast<HandModel>(*hand);
  const bool simulated = spec.driver == "simulated";
  if (simulated) {
    constexpr std::array<const char*, 4> models{"plain", "touch", "premium", "omega"};
    if (const auto model = reader.read_word("model", {"plain", "touch", "premium", "omega"}))
      spec.options.emplace_back("model", models[*model]);
  }
  if (simulated) reader.require("waypoints", "a simulated hand follows a list of [t_s, x_mm, y_mm, z_mm]");
  if (!simulated && !spec.driver.empty()) read_options(reader, spec);
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_devices(TableReader& root, ReadContext& context) {
  for (const auto& [name, table] : named_tables(root, "device")) {
    TableReader reader(*table, fmt::format("[device.{}]", name), context.complaints);
    auto spec = read_device(reader);
    spec.name = name;
    context.scene.devices.push_back(std::move(spec));
  }
}

}  // namespace palpate
