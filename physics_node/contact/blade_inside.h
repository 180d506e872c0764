#pragma once
// What an edge sweeps inside bodies that it neither cuts nor feels: for who has to know that it went where it should
// not.
//
// A place is inside where the surface takes up more than half of all directions as seen from it, with its sign: solid
// angles add up to 4 pi inside of what is closed, and to 0 outside. Source: Van Oosterom & Strackee 1983.

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/blade_links.h"
#include "physics_node/contact/point_tool.h"

namespace palpate::physics {

class BladeInside {
 public:
  /// @param bodies  which outlive this @param passed  those of them that it does not cut @param length  of the edge [m]
  BladeInside(const std::vector<TouchableBody>& bodies, std::vector<std::size_t> passed, double length);

  /// After a frame. Allocates nothing. Cost: none where it cuts all bodies or stands still, else a look at so many
  /// facets a frame that it is some 0.1 ms; a look at bodies with many takes several frames, in which they move little.
  void follow(const BladeFrame& frame) noexcept;
  /// What comes next is somewhere else.
  void let_go() noexcept { looking_ = seen_ = false; }
  void reset() noexcept;

  /// Swept across the edge, inside each body of the scene [m^2].
  std::span<const double> areas() const noexcept { return area_; }

 private:
  static constexpr std::size_t n_points = 16;
  using Points = std::array<Vec3, n_points>;

  bool begin_look(const BladeFrame& frame) noexcept;
  void find_box() noexcept;
  void add_angles() noexcept;
  void end_body() noexcept;
  const Boundary& surface() const noexcept { return *bodies_[passed_[at_]].surface; }
  Vec3 corner(std::uint32_t facet, std::size_t corner) const noexcept {
    return surface().position(facet, corner, *bodies_[passed_[at_]].moving);
  }
  std::uint32_t end_of_part(std::size_t facets) const noexcept;

  const std::vector<TouchableBody>& bodies_;
  std::vector<std::size_t> passed_;
  double length_;
  std::vector<double> area_;
  std::vector<std::array<bool, n_points>> inside_;  // of each that it passes, when last looked at
  Points point_, before_;                           // of this look and of the last [m]
  Vec3 along_ = Vec3::UnitZ();
  std::array<double, n_points> angle_{};
  Eigen::AlignedBox3d box_;  // of the body that is looked at, as far as that has come
  bool seen_ = false, looking_ = false;
  std::size_t at_ = 0;  // of passed_
  enum class Part { box, angles } part_ = Part::box;
  std::uint32_t facet_ = 0;  // the next of that
};

}  // namespace palpate::physics
