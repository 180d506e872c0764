#include "haptic_node/drivers/simulated/simulated_options.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace palpate::haptic::simulated {
namespace {

bool read_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

std::string read_positive(const std::string& key, const std::string& text, double& value) {
  if (read_number(text, value) && value > 0) return {};
  return key + " is \"" + text + "\"; a number above 0 is wanted";
}

std::string read_hand(const std::string& text, HandParameters& hand) {
  static const std::pair<const char*, HandParameters> models[] = {{"rigid", {0, 0, 0, true}},
                                                                  {"arm", {0.554, 6.45, 135.0, false}},
                                                                  {"pinch", {0.02, 1.0, 100.0, false}},
                                                                  {"firm", {0.15, 5.0, 700.0, false}}};
  for (const auto& [name, parameters] : models) {
    if (text != name) continue;
    hand = parameters;
    return {};
  }
  return "hand is \"" + text + "\"; rigid, arm, pinch or firm are known";
}

std::string read_model(const std::string& text, SimulatedOptions& options) {
  static const std::pair<const char*, DeviceParameters> models[] = {
      {"plain", {}},
      {"touch", {0.045, 0.3, 0.26, 55e-6, 3.3, 0.88, 1000}},
      {"premium", {0.075, 0.02, 0.04, 30e-6, 8.5, 1.4, 500}},
      {"omega", {0.2, 1.0, 0.3, 10e-6, 12, 12, 5000}}};
  for (const auto& [name, parameters] : models) {
    if (text != name) continue;
    options.device = parameters;
    options.model = name;
    return {};
  }
  return "model is \"" + text + "\"; plain, touch, premium or omega are known";
}

std::string read_max_force(const std::string& key, const std::string& text, DeviceParameters& device) {
  const std::string trouble = read_positive(key, text, device.max_force);
  device.cont_force = device.max_force;
  return trouble;
}

std::string read_waypoints(const std::string& text, std::vector<PathPoint>& waypoints) {
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream fields(item);
    std::string t, x, y, z, more;
    PathPoint point;
    fields >> t >> x >> y >> z;
    if (fields >> more || !read_number(t, point.t) || !read_number(x, point.p[0]) ||
        !read_number(y, point.p[1]) || !read_number(z, point.p[2]))
      return "waypoint \"" + item + "\": four numbers are wanted, \"t x y z\"";
    if (!waypoints.empty() && point.t <= waypoints.back().t)
      return "waypoint \"" + item + "\": its time must be after the one before";
    waypoints.push_back(point);
  }
  return {};
}

std::string read_not_negative(const std::string& key, const std::string& text, double& value) {
  if (read_number(text, value) && value >= 0) return {};
  return key + " is \"" + text + "\"; a number not below 0 is wanted";
}

std::string read_attitudes(const std::string& text, std::vector<AttitudePoint>& attitudes) {
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream fields(item);
    std::array<std::string, 5> word;
    std::string more;
    for (std::string& one : word) fields >> one;
    AttitudePoint point;
    bool good = !(fields >> more) && read_number(word[0], point.t);
    double squared = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      good = good && read_number(word[i + 1], point.q[i]);
      squared += point.q[i] * point.q[i];
    }
    if (!good || std::abs(squared - 1) > 1e-6)
      return "attitude \"" + item + "\": a time and a unit quaternion are wanted, \"t w x y z\"";
    if (!attitudes.empty() && point.t <= attitudes.back().t)
      return "attitude \"" + item + "\": its time must be after the one before";
    attitudes.push_back(point);
  }
  return {};
}

std::string read_pressed(const std::string& text, std::vector<PressedSpan>& pressed) {
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream fields(item);
    std::string from, to, more;
    PressedSpan span;
    fields >> from >> to;
    if (fields >> more || !read_number(from, span.from) || !read_number(to, span.to) ||
        !(span.to > span.from))
      return "pressed \"" + item + "\": two times that grow are wanted, \"from to\"";
    pressed.push_back(span);
  }
  return {};
}

/// What was not said follows from hand and device at the end of the lever. @return empty, or why it cannot be stepped
std::string complete(SimulatedOptions& options) {
  TurnParameters& turn = options.turn;
  const auto unless_said = [](double& value, double otherwise) {
    if (value < 0) value = otherwise;
  };
  constexpr double l = turn_lever;
  unless_said(turn.inertia, l * l * (options.hand.mass + options.device.mass));
  unless_said(turn.damping, l * l * options.hand.damping);
  unless_said(turn.stiffness, l * l * options.hand.stiffness);
  unless_said(turn.friction, l * options.device.friction);
  turn.drag = l * l * options.device.damping;
  constexpr double h = step_s;
  if (options.turns() && h * (turn.damping + turn.drag) + h * h * turn.stiffness > turn.inertia)
    return "turn_inertia is too small for turn_damping and turn_stiffness: it would swing within a step of "
           "20 us";
  return {};
}

std::string read_one(const std::string& key, const std::string& value, SimulatedOptions& options) {
  if (key == "waypoints") return read_waypoints(value, options.waypoints);
  if (key == "hand") return read_hand(value, options.hand);
  if (key == "model") return read_model(value, options);
  if (key == "mass") return read_positive(key, value, options.device.mass);
  if (key == "max_force") return read_max_force(key, value, options.device);
  if (key == "max_stiffness") return read_positive(key, value, options.device.max_stiffness);
  if (key == "attitudes") return read_attitudes(value, options.attitudes);
  if (key == "pressed") return read_pressed(value, options.pressed);
  if (key == "max_torque") return read_positive(key, value, options.turn.max_torque);
  if (key == "turn_inertia") return read_positive(key, value, options.turn.inertia);
  if (key == "turn_damping") return read_not_negative(key, value, options.turn.damping);
  if (key == "turn_stiffness") return read_not_negative(key, value, options.turn.stiffness);
  if (key == "turn_friction") return read_not_negative(key, value, options.turn.friction);
  if (key == "half_workspace") return read_positive(key, value, options.half_workspace);
  if (key == "noise") return read_positive(key, value, options.noise);
  if (key == "seed") {
    char* end = nullptr;
    options.seed = std::strtoull(value.c_str(), &end, 10);
    return !value.empty() && *end == '\0' ? "" : "seed is \"" + value + "\"; a whole number is wanted";
  }
  return "unknown key \"" + key +
         "\"; known are waypoints, attitudes, pressed, hand, model, mass, max_force, max_stiffness, "
         "max_torque, "
         "turn_inertia, "
         "turn_damping, turn_stiffness, turn_friction, half_workspace, noise, seed";
}

}  // namespace

std::string parse_options(const char* const* kv, std::uint32_t n_kv, SimulatedOptions& options) {
  for (std::uint32_t i = 0; i < n_kv; ++i) {
    const std::string trouble = read_one(kv[2 * i], kv[2 * i + 1], options);
    if (!trouble.empty()) return trouble;
  }
  for (const auto& point : options.waypoints) {
    for (const double coordinate : point.p) {
      if (std::abs(coordinate) <= options.half_workspace) continue;
      std::ostringstream text;
      text << "the waypoint at " << point.t << " s is " << std::abs(coordinate)
           << " m from the device's origin, outside its workspace of +-" << options.half_workspace
           << " m; move the device with offset_mm, or enlarge half_workspace";
      return text.str();
    }
  }
  return complete(options);
}

}  // namespace palpate::haptic::simulated
