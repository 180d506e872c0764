#include "render_node/model/threshold_control.h"

#include <algorithm>
#include <variant>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"

namespace palpate::render {

ThresholdControl::ThresholdControl(const Scene& scene) {
  for (const auto& body : scene.bodies) {
    const auto* volume = std::get_if<VolumeShape>(&body.shape);
    if (volume == nullptr || body.lattice != LatticeKind::voxel)
      continue;  // only cells are shown by intensity
    applies_ = true;
    if (volume->keep_min < 0 || volume->keep_max > 255) {
      lo_ = -1024;
      hi_ = 3071;
    }
    obey(std::clamp(scene.render->threshold.value_or(volume->keep_min), lo_, hi_));
    return;
  }
}

std::optional<double> ThresholdControl::due(double now, bool released) noexcept {
  return pace_.due(value_, now, released) ? std::optional(value_) : std::nullopt;
}

}  // namespace palpate::render
