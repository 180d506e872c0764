#include "render_node/view/surface_under.h"

#include <algorithm>

#include "render_node/view/line_of_action.h"

namespace palpate::render {

std::optional<Vec3> surface_under(std::span<const BodyPicture> bodies, const Camera& camera,
                                  const Eigen::Vector2d& pixel, double before) {
  const Vec3 eye = camera.eye();
  const Vec3 ray = (camera.at(pixel, 1.0) - eye).normalized();
  std::optional<double> nearest;
  double off = 0;
  for (const BodyPicture& body : bodies) {
    if (body.empty()) continue;
    const auto s = first_hit(body.surface(), eye, ray, 0.0);
    if (!s || (nearest && *s >= *nearest)) continue;
    nearest = s;
    off = before + 0.5 * static_cast<double>(body.edge_length());
  }
  if (!nearest) return std::nullopt;
  return eye + std::max(0.0, *nearest - off) * ray;
}

}  // namespace palpate::render
