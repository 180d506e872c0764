#pragma once
// The threshold slider's manners: its range, and at most five commands a second while it is dragged.

#include <optional>

#include "common/scene/scene_fwd.h"
#include "render_node/model/command_pace.h"

namespace palpate::render {

class ThresholdControl {
 public:
  /// Range and start from the first volume of the scene: -1024..3071 where its window is that of a CT,
  /// 0..255 otherwise.
  explicit ThresholdControl(const Scene& scene);

  bool applies() const noexcept { return applies_; }  // false: no body comes from a volume
  double lo() const noexcept { return lo_; }
  double hi() const noexcept { return hi_; }
  double value() const noexcept { return value_; }

  /// The hand set the slider.
  void set(double value) noexcept { value_ = value; }
  /// Somebody commanded this value: show it, and do not command it again.
  void obey(double value) noexcept { value_ = value, pace_.obey(value); }
  /// What to command now, if anything: a value not yet commanded, not sooner than allowed unless released.
  /// @param now  wall time [s]
  std::optional<double> due(double now, bool released) noexcept;

 private:
  bool applies_ = false;
  double lo_ = 0, hi_ = 255, value_ = 0;
  CommandPace<double> pace_;
};

}  // namespace palpate::render
