// Whether the camera of the scene sees anything, against the ball round all bodies, and its section cuts any.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "physics_node/remarks/remarks.h"

namespace palpate::physics {
namespace {

Remarks section_remarks(const Scene& scene, const Bodies& bodies) {
  const auto& section = scene.render->section;
  if (!section) return {};
  Eigen::AlignedBox3d box;
  for (const auto& body : bodies) box.extend(box_of(body->body()));
  const double low = box.min()[section->axis], high = box.max()[section->axis];
  if (box.isEmpty() || (section->at >= low && section->at <= high)) return {};
  return {fmt::format(
      "{}: [render] section at {} = {:.4g} mm meets no body, and nothing is cut open; they go from "
      "{:.4g} to {:.4g} mm",
      scene.path, section_name(section), 1e3 * section->at, 1e3 * low, 1e3 * high)};
}

Remarks camera_remarks(const Scene& scene, const Bodies& bodies) {
  const CameraSpec& camera = scene.render->camera;
  if (!camera.target && !camera.distance) return {};  // fitted to the bodies
  Eigen::AlignedBox3d box;
  for (const auto& body : bodies) box.extend(box_of(body->body()));
  const double radius = 0.5 * box.diagonal().norm();
  if (box.isEmpty() || !(radius > 0) || !camera.distance) return {};
  const Vec3 target = camera.target.value_or(box.center());
  // Yaw 0 stands on the -y side (render_node/view/camera.h).
  const Vec3 back(std::sin(camera.yaw) * std::cos(camera.pitch),
                  -std::cos(camera.yaw) * std::cos(camera.pitch), std::sin(camera.pitch));
  const Vec3 eye = target + *camera.distance * back, to = box.center() - eye;
  const double away = to.norm();
  const std::string place = scene.path + ": [render] camera";
  if (away <= radius) return {};  // it stands among them
  const double wide = static_cast<double>(scene.render->size_px[0]) / scene.render->size_px[1];
  const double half = std::atan(std::tan(0.5 * camera.field_of_view) * std::max(1.0, wide));
  const double off = std::acos(std::clamp(-to.dot(back) / away, -1.0, 1.0)), ball = std::asin(radius / away);
  if (off > half + ball)
    return {fmt::format(
        "{} looks past all bodies, which lie {:.0f} degrees aside; leave target_mm out, or give their middle "
        "[{:.4g}, "
        "{:.4g}, {:.4g}]",
        place, off * 180 / M_PI, 1e3 * box.center().x(), 1e3 * box.center().y(), 1e3 * box.center().z())};
  constexpr double smallest = 0.02;  // of the picture's height
  if (ball / (0.5 * camera.field_of_view) < smallest)
    return {
        fmt::format("{} stands {:.3g} m from bodies of {:.3g} m, which are a dot in the picture; distance_mm "
                    "is in millimetres",
                    place, away, 2 * radius)};
  return {};
}

}  // namespace

Remarks picture_remarks(const Scene& scene, const Bodies& bodies) {
  Remarks all = camera_remarks(scene, bodies);
  for (auto& line : section_remarks(scene, bodies)) all.push_back(std::move(line));
  return all;
}

}  // namespace palpate::physics
