#pragma once
// The section that a person wishes: across no axis or one, and where; at most five commands a second while it is moved.

#include <Eigen/Geometry>
#include <optional>

#include "common/scene/section_spec.h"
#include "render_node/model/command_pace.h"

namespace palpate::render {

class SectionControl {
 public:
  explicit SectionControl(const Scene& scene);

  bool applies() const noexcept { return applies_; }  // false: no body has a section to show
  const std::optional<SectionSpec>& value() const noexcept { return value_; }

  /// Across no axis, x, y, z, and none again; through the middle of the box, or where it was last across that axis.
  void next(const Eigen::AlignedBox3d& box) noexcept;
  void choose(int axis, const Eigen::AlignedBox3d& box) noexcept;
  void close() noexcept { value_.reset(); }
  /// To a place on its axis, within the box [m].
  void move_to(double at, const Eigen::AlignedBox3d& box) noexcept;
  /// By hundredths of the box.
  void move(int steps, const Eigen::AlignedBox3d& box) noexcept;

  /// Somebody commanded this: show it, and do not command it again.
  void obey(const std::optional<SectionSpec>& value) noexcept { value_ = value, pace_.obey(value); }
  /// What to command now, if anything. @param now  wall time [s]
  bool due(double now, bool released) noexcept { return pace_.due(value_, now, released); }

 private:
  bool applies_ = false;
  std::optional<SectionSpec> value_;
  std::array<std::optional<double>, 3> last_;  // across each axis [m]
  CommandPace<std::optional<SectionSpec>> pace_;
};

}  // namespace palpate::render
