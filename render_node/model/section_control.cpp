#include "render_node/model/section_control.h"

#include <algorithm>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"

namespace palpate::render {

SectionControl::SectionControl(const Scene& scene)
    : applies_(!bodies_with_section(scene).empty()), value_(scene.render->section), pace_(value_) {
  if (value_) last_[static_cast<std::size_t>(value_->axis)] = value_->at;
}

void SectionControl::choose(int axis, const Eigen::AlignedBox3d& box) noexcept {
  const double middle = box.isEmpty() ? 0 : box.center()[axis];
  value_ = SectionSpec{axis, last_[static_cast<std::size_t>(axis)].value_or(middle)};
}

void SectionControl::next(const Eigen::AlignedBox3d& box) noexcept {
  const int axis = value_ ? value_->axis + 1 : 0;
  if (axis > 2) return close();
  choose(axis, box);
}

void SectionControl::move_to(double at, const Eigen::AlignedBox3d& box) noexcept {
  if (!value_) return;
  if (!box.isEmpty()) at = std::clamp(at, box.min()[value_->axis], box.max()[value_->axis]);
  value_->at = at;
  last_[static_cast<std::size_t>(value_->axis)] = at;
}

void SectionControl::move(int steps, const Eigen::AlignedBox3d& box) noexcept {
  if (value_ && !box.isEmpty()) move_to(value_->at + 0.01 * steps * box.sizes()[value_->axis], box);
}

}  // namespace palpate::render
