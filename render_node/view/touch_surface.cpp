#include "render_node/view/touch_surface.h"

#include <algorithm>

#include "render_node/view/hidden.h"
#include "render_node/view/line_of_action.h"

namespace palpate::render {

void TouchSurface::keep(std::span<const BodyPicture> bodies, const std::vector<bool>& hidden,
                        const std::optional<Eigen::Vector4f>& cut) {
  asked_.reset();
  kept_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].empty() || is_hidden(hidden, i)) continue;
    kept_.push_back({bodies[i].surface(), static_cast<double>(bodies[i].edge_length())});
    if (!cut) continue;
    const auto rest = bodies[i].rest();
    std::erase_if(kept_.back().surface.corners, [&](const Corners& corners) {
      return std::ranges::all_of(corners, [&](std::uint32_t c) {
        return is_cut_away(*cut, Eigen::Map<const Eigen::Vector3f>(rest[c].data()));
      });
    });
  }
}

void TouchSurface::keep_sections(std::span<const BodyPicture> sections) {
  for (const BodyPicture& section : sections)
    if (!section.empty()) kept_.push_back({section.surface(), 0, true});
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
  bool blocked = false;
  for (const Kept& body : kept_) {
    const auto depth = first_hit(body.surface, eye, ray, 0.0);
    if (!depth || (nearest && *depth >= *nearest)) continue;
    nearest = depth;
    off = before + 0.5 * body.edge;
    blocked = body.blocks;
  }
  if (nearest && !blocked) answer_ = eye + std::max(0.0, *nearest - off) * ray;
  return answer_;
}

}  // namespace palpate::render
