#include "render_node/model/inside_control.h"

#include <algorithm>

#include "common/scene/inside_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "render_node/model/threshold_control.h"

namespace palpate::render {
namespace {

constexpr double bone = 300;  // Why: soft tissue with contrast stays below, thin bone above [HU]

}  // namespace

InsideControl::InsideControl(const Scene& scene)
    : applies_(!bodies_with_inside(scene).empty()),
      on_(applies_ && scene.render->inside.has_value()),
      opacity_(scene.render->opacity) {
  const ThresholdControl scale(scene);
  lo_ = scale.lo(), hi_ = scale.hi();
  from_ = std::clamp(scene.render->inside.value_or(lo_ < 0 ? bone : (lo_ + hi_) / 2), lo_, hi_);
  pace_.obey(scene.render->inside);
}

void InsideControl::toggle() noexcept {
  if (!applies_) return;
  on_ = !on_;
  if (!on_)
    opacity_ = 1;
  else if (opacity_ == 1)
    opacity_ = veil;
}

void InsideControl::set_opacity(double opacity) noexcept {
  opacity_ = std::clamp(opacity, least_opacity, 1.0);
}

void InsideControl::obey(const std::optional<double>& value) noexcept {
  if (!applies_) return;
  on_ = value.has_value();
  if (value) from_ = *value;
  pace_.obey(value);
}

}  // namespace palpate::render
