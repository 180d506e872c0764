#include "haptic_node/drivers/inverse3/haply_message.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace palpate::haptic::inverse3 {
namespace {

using nlohmann::json;

/// The object `key` in `object`, or null.
const json* child(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// Components that are there. @return false if one is no finite number
template <std::size_t N>
bool take(const json* object, const std::array<const char*, N>& names, std::array<double, N>& values) {
  if (object == nullptr) return true;
  for (std::size_t i = 0; i < N; ++i) {
    const json* part = child(*object, names[i]);
    if (part == nullptr) continue;
    if (!part->is_number() || !std::isfinite(part->get<double>())) return false;
    values[i] = part->get<double>();
  }
  return true;
}

/// The entry of `device` in the list `key`, or the first one if `device` is empty.
const json* entry(const json& message, const char* key, const std::string& device) {
  const json* list = child(message, key);
  if (list == nullptr || !list->is_array()) return nullptr;
  for (const auto& one : *list) {
    const json* id = child(one, "device_id");
    if (device.empty() || (id != nullptr && id->is_string() && *id == device)) return &one;
  }
  return nullptr;
}

void take_grip(const json& message, HaplyState& state) {
  for (const char* key : {"verse_grip", "wireless_verse_grip"}) {
    const json* grip = entry(message, key, "");
    const json* said = grip == nullptr ? nullptr : child(*grip, "state");
    if (said == nullptr) continue;
    std::array<double, 4> q = state.grip;
    if (child(*said, "orientation") != nullptr &&
        take<4>(child(*said, "orientation"), {"w", "x", "y", "z"}, q)) {
      state.grip = q;
      state.has_grip = true;
    }
    const json* buttons = child(*said, "buttons");
    for (std::uint32_t i = 0; buttons != nullptr && i < 3; ++i) {
      const json* button = child(*buttons, std::array<const char*, 3>{"a", "b", "c"}[i]);
      if (button == nullptr || !button->is_boolean()) continue;
      state.buttons = (state.buttons & ~(1u << i)) | (button->get<bool>() ? 1u << i : 0u);
    }
  }
}

void take_status(const json* status, HaplyState& state) {
  constexpr std::array<const char*, n_haply_flags> names{"power_supply", "calibrated", "ready"};
  for (std::size_t i = 0; status != nullptr && i < names.size(); ++i) {
    const json* flag = child(*status, names[i]);
    if (flag != nullptr && flag->is_boolean()) state.flags[i] = flag->get<bool>() ? Said::yes : Said::no;
  }
}

std::string with_session(const Dialect& dialect, json message, bool first) {
  if (first) message["session"]["configure"]["profile"]["name"] = dialect.profile;
  return message.dump();
}

}  // namespace

std::vector<std::string> devices_in(const std::string& message) {
  std::vector<std::string> ids;
  const json parsed = json::parse(message, nullptr, false);
  const json* list = child(parsed, "inverse3");
  if (list == nullptr || !list->is_array()) return ids;
  for (const auto& one : *list) {
    const json* id = child(one, "device_id");
    if (id != nullptr && id->is_string()) ids.push_back(id->get<std::string>());
  }
  return ids;
}

bool take_update(const std::string& message, const std::string& device, HaplyState& state) {
  const json parsed = json::parse(message, nullptr, false);
  const json* found = entry(parsed, "inverse3", device);
  const json* said = found == nullptr ? nullptr : child(*found, "state");
  if (said == nullptr) return false;
  HaplyState next = state;
  if (!take<3>(child(*said, "cursor_position"), {"x", "y", "z"}, next.position)) return false;
  if (!take<3>(child(*said, "cursor_velocity"), {"x", "y", "z"}, next.velocity)) return false;
  const json* applied = child(*said, "current_cursor_force");
  next.tells_applied = applied != nullptr;
  if (!take<3>(applied, {"x", "y", "z"}, next.applied)) return false;
  take_status(child(*found, "status"), next);
  take_grip(parsed, next);
  state = next;
  return true;
}

std::string force_message(const Dialect& dialect, const std::string& device,
                          const std::array<double, 3>& force, bool first) {
  json one;
  one["device_id"] = device;
  one["commands"]["set_cursor_force"][dialect.force_key] = {
      {"x", force[0]}, {"y", force[1]}, {"z", force[2]}};
  return with_session(dialect, {{"inverse3", json::array({one})}}, first);
}

std::string probe_message(const Dialect& dialect, const std::string& device, bool first) {
  json one;
  one["device_id"] = device;
  one["commands"]["probe_position"] = json::object();
  return with_session(dialect, {{"inverse3", json::array({one})}}, first);
}

}  // namespace palpate::haptic::inverse3
