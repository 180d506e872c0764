#include "render_node/view/touch_surface.h"

#include <algorithm>

#include "render_node/view/hidden.h"
#include "render_node/view/line_of_action.h"

namespace palpate::render {

void TouchSurface::keep(std::span<const BodyPicture> bodies, const std::vector<bool>& hidden) {
  asked_.reset();
  kept_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].empty() || is_hidden(hidden, i)) continue;
    kept_.push_back({bodies[i].surface(), static_cast<double>(bodies[i].edge_length())});
  }
}

std::optional<Vec3> TouchSurface::under(const Camera& camera, const Eigen::Vector2d& pixel, double before) {
  const Eigen::Matrix4d view = camera.projection() * camera.view();
  if (asked_ && asked_->pixel == pixel && asked_->view == view && asked_->before == before) return answer_;
  asked_ = Asked{pixel, view, before};
  answer_.reset();
  const Vec3 eye = camera.eye();
  const Vec3 ray = camera.at(pixel, 1.0) - eye;  // 1 deep, so that lengths along it are depths
  std::optional<double> nearest;
  double off = 0;
  for (const Kept& body : kept_) {
    const auto depth = first_hit(body.surface, eye, ray, 0.0);
    if (!depth || (nearest && *depth >= *nearest)) continue;
    nearest = depth;
    off = before + 0.5 * body.edge;
  }
  if (nearest) answer_ = eye + std::max(0.0, *nearest - off) * ray;
  return answer_;
}

}  // namespace palpate::render
