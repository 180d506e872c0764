// [device.NAME]: a haptic device, or the simulated hand.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/scene/device_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

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

/// A list of [t_s, n numbers] whose times grow, each passed to `add(numbers)`. @return how many there are
template <class Add>
std::optional<std::size_t> read_path(TableReader& reader, const char* key, std::string_view what,
                                     std::string_view form, std::size_t n, Add add) {
  const auto* list = reader.read_array(key, fmt::format("a list of {}", form));
  if (list == nullptr) return std::nullopt;
  double last = -1;
  bool in_order = true;
  for (const auto& item : *list) {
    const auto numbers = numbers_of(item, n + 1);
    if (!numbers) {
      reader.complain_value(key, item, form);
      continue;
    }
    const double t = (*numbers)[0];
    if (t > run_seconds.hi ||
        std::any_of(numbers->begin() + 1, numbers->end(), [](double x) { return std::abs(x) > 1e6; })) {
      reader.complain_value(key, item, fmt::format("{}, each at most 1e6", form));
      in_order = false;
      continue;
    }
    const bool late_enough = last < 0 ? t >= 0 : t > last;
    if (!late_enough && in_order) {
      reader.complain_at(place_of(item.source()),
                         last < 0
                             ? fmt::format("the path starts at {} s; times start at 0 or later", t)
                             : fmt::format("{} at {} s follows one at {} s; times must grow", what, t, last));
      in_order = false;  // say it once
    }
    last = std::max(0.0, t);
    add(*numbers);
  }
  return list->size();
}

void read_waypoints(TableReader& reader, DeviceSpec& spec) {
  constexpr std::string_view form = "[t_s, x_mm, y_mm, z_mm]";
  const auto n = read_path(reader, "waypoints", "waypoint", form, 3, [&](const auto& x) {
    spec.waypoints.push_back({x[0], Vec3(x[1], x[2], x[3]) * m_from_mm(1.0)});
  });
  if (n && *n < 2)
    reader.complain("waypoints",
                    fmt::format("the path is too short; write two waypoints or more, each {}", form));
}

/// How the simulated hand turns, as the driver has it: SI without units in the names. Attitudes are those in the world.
void read_turning(TableReader& reader, DeviceSpec& spec) {
  std::string attitudes;
  read_path(reader, "attitudes_deg", "attitude", "[t_s, about z, about y, about x]", 3, [&](const auto& x) {
    const Eigen::Quaterniond q(
        rotation_of_angles({rad_from_deg(x[1]), rad_from_deg(x[2]), rad_from_deg(x[3])}));
    attitudes += fmt::format("{}{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", attitudes.empty() ? "" : "; ", x[0],
                             q.w(), q.x(), q.y(), q.z());
  });
  if (!attitudes.empty()) spec.options.emplace_back("attitudes", attitudes);
  struct Key {
    const char *in_scene, *of_driver;
    Range range;
  };
  for (const Key& key :
       {Key{"max_torque_N_m", "max_torque", positive}, Key{"turn_inertia_kg_m2", "turn_inertia", positive},
        Key{"turn_damping_N_m_s_per_rad", "turn_damping", not_negative},
        Key{"turn_stiffness_N_m_per_rad", "turn_stiffness", not_negative},
        Key{"turn_friction_N_m", "turn_friction", not_negative}}) {
    const auto value = reader.read_number(key.in_scene, key.range);
    if (!value) continue;
    spec.options.emplace_back(key.of_driver, fmt::format("{:.17g}", *value));
    if (!reader.has("attitudes_deg") && !reader.has("max_torque_N_m"))
      reader.complain(
          key.in_scene,
          fmt::format("\"{}\" in {} is of a hand that turns; give attitudes_deg or max_torque_N_m, too",
                      key.in_scene, reader.title()));
  }
}

/// When the simulated hand presses its button.
void read_pressed(TableReader& reader, DeviceSpec& spec) {
  constexpr std::string_view form = "[from_s, to_s]";
  std::string spans;
  read_path(reader, "pressed_s", "a span", form, 1, [&](const auto& x) {
    if (!(x[1] > x[0]))
      reader.complain("pressed_s",
                      fmt::format("a span from {} to {} s has no length; write {}", x[0], x[1], form));
    spans += fmt::format("{}{:.17g} {:.17g}", spans.empty() ? "" : "; ", x[0], x[1]);
  });
  if (!spans.empty()) spec.options.emplace_back("pressed", spans);
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
    read_turning(reader, spec);
    read_pressed(reader, spec);
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
