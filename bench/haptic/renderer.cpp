#include "bench/haptic/renderer.h"

#include <algorithm>

#include "common/message/vec3.h"

namespace palpate::bench {

const char* name_of(RenderMode mode) noexcept {
  switch (mode) {
    case RenderMode::local:
      return "local";
    case RenderMode::raw_planes:
      return "raw planes";
    case RenderMode::direct:
      return "direct";
  }
  return "";
}

Rendered raw_plane_force(const ContactPatch& patch, const Vec3& x, const Vec3& v,
                         const haptic::ControllerSettings& settings) noexcept {
  Rendered out;
  out.proxy = x;
  if (patch.n_facets == 0) return out;
  const Vec3 n = vec(patch.facets[0].normal);
  const double depth = -n.dot(x - vec(patch.facets[0].point));
  if (depth <= 0) return out;
  const double force = settings.stiffness * depth - settings.damping * n.dot(v);
  out.force = std::clamp(force, 0.0, settings.force_limit) * n;
  out.reported = out.force;
  out.proxy = x + depth * n;
  out.stored = 0.5 * settings.stiffness * depth * depth;
  out.touching = true;
  return out;
}

Rendered local_force(haptic::Controller& controller, std::int64_t now_ns, const haptic::DeviceSample& sample,
                     const ContactPatch* patch) noexcept {
  const haptic::ControllerOutput answer = controller.tick(now_ns, sample, patch);
  Rendered out;
  out.force = answer.write ? answer.force : Vec3(Vec3::Zero());
  out.reported = answer.reported;
  out.proxy = answer.proxy;
  out.stored = controller.stored();
  out.plane_work = controller.plane_work();
  out.touching = controller.contact().n_planes > 0;
  out.want_power = answer.want_power;
  return out;
}

}  // namespace palpate::bench
