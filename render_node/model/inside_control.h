#pragma once
// What a person wishes to see of what lies inside of images: from which intensity on, or nothing; and how opaque tissue is that
// lies before it. At most five commands a second while it is moved.

#include <optional>

#include "common/scene/scene_fwd.h"
#include "render_node/model/command_pace.h"

namespace palpate::render {

class InsideControl {
 public:
  static constexpr double least_opacity = 0.05;
  static constexpr double veil =
      0.35;  // opacity that the inside is shown through, if a person has chosen no other

  /// Begins with what the scene has. Else with bone where the window of the first image is that of a CT, or with the brighter half of
  /// its scale.
  explicit InsideControl(const Scene& scene);

  bool applies() const noexcept { return applies_; }  // false: there is no image
  std::optional<double> value() const noexcept { return on_ ? std::optional(from_) : std::nullopt; }
  double lo() const noexcept { return lo_; }
  double hi() const noexcept { return hi_; }
  double opacity() const noexcept { return opacity_; }

  /// Shows it through the tissue, or no more.
  void toggle() noexcept;
  void set(double from) noexcept { from_ = from; }
  void set_opacity(double opacity) noexcept;
  /// Somebody commanded this: show it, and do not command it again.
  void obey(const std::optional<double>& value) noexcept;
  /// What to command now, if anything. @param now  wall time [s]
  bool due(double now, bool released) noexcept { return applies_ && pace_.due(value(), now, released); }

 private:
  bool applies_ = false, on_ = false;
  double lo_ = 0, hi_ = 255, from_ = 0, opacity_ = 1;
  CommandPace<std::optional<double>> pace_;
};

}  // namespace palpate::render
