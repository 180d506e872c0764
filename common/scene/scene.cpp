#include "common/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/record_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"

namespace palpate {
namespace {

template <class Spec>
const Spec& named(const std::vector<Spec>& specs, const std::string& name) {
  const auto found =
      std::find_if(specs.begin(), specs.end(), [&name](const Spec& spec) { return spec.name == name; });
  PALPATE_CHECK(found != specs.end(), name.c_str());
  return *found;
}

}  // namespace

std::string Place::text() const { return line == 0 ? file : fmt::format("{}:{}:{}", file, line, column); }

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

const MaterialSpec& Scene::material(const std::string& name) const { return named(materials, name); }
const DeviceSpec& Scene::device(const std::string& name) const { return named(devices, name); }

double Scene::natural_seconds() const {
  constexpr double without_path = 5.0, after_path = 1.0;
  if (seconds) return *seconds;
  double end = without_path - after_path;
  bool any = false;
  for (const auto& device : devices) {
    if (device.waypoints.empty()) continue;
    end = any ? std::max(end, device.waypoints.back().t) : device.waypoints.back().t;
    any = true;
  }
  return end + after_path;
}

}  // namespace palpate
