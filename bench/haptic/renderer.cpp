#include "bench/haptic/renderer.h"

#include "haptic_node/contact/raw_planes.h"

namespace palpate::bench {

const char* name_of(RenderMode mode) noexcept {
  switch (mode) {
    case RenderMode::local:
      return "local";
    case RenderMode::raw_planes:
      return "raw planes";
    case RenderMode::direct:
      return "direct";
    case RenderMode::copy:
      return "copy";
    case RenderMode::extrapolated:
      return "extrapolated";
  }
  return "";
}

Rendered raw_plane_force(const ContactPatch& patch, const Vec3& x, const Vec3& v,
                         const haptic::ControllerSettings& settings) noexcept {
  const haptic::ContactResult felt =
      haptic::raw_plane_force(patch, {x, v, Eigen::Quaterniond::Identity()}, settings.stiffness,
                              settings.damping, settings.force_limit);
  Rendered out;
  out.force = out.reported = felt.force;
  out.proxy = felt.proxy;
  out.stored = felt.stored;
  out.touching = felt.n_planes > 0;
  return out;
}

Rendered local_force(haptic::Controller& controller, std::int64_t now_ns, const haptic::DeviceSample& sample,
                     const ContactPatch* patch, const ToolWrench* wrench) noexcept {
  const haptic::ControllerOutput answer = controller.tick(now_ns, sample, patch, wrench);
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
