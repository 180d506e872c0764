#pragma once
// The nearest surface under a stick as a Norton spring: where it is without the stick's force, how stiffly the tissue behind
// it answers, and where along the stick it presses.
//
// Plane and spread come from the facets under the stick (stick_plane.h), stiffness and place from what the stick's masses
// have pressed lately: K_o = F / d, and the force acts at c of the stick's length, which tends to the measured moment's
//
//   c = (n x M) . D_n / (F D_n^2),   D_n the part of the axis D that lies in the plane
//
// Both have time constants of 150 ms, so that the tissue's own swinging stays out of the loop through the hand.
// Facets whose masses are all held do not give: with a share h of the weights K_o counts as K_o / (1 - h)^2.

#include <optional>
#include <span>
#include <vector>

#include "physics_node/contact/norton_spring.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/contact/secant_stiffness.h"
#include "physics_node/contact/stick_plane.h"

namespace palpate::physics {

class StickSpring {
 public:
  /// @param bodies  outlive it. @param radius  of the stick [m]
  StickSpring(const std::vector<TouchableBody>& bodies, double radius);
  void reset() noexcept;

  /// Looks for facets around the stick, of every body.
  void look(const Stick& stick, double t) noexcept;
  /// Once a frame, at its end.
  /// @param felt  of the tissue on the stick, low-passed, about its tip [N], [N m]
  void follow(const Stick& stick, const Vec6& felt, double dt) noexcept;
  /// Of the body whose surface the stick is lowest above; none: nothing is near.
  const std::optional<NortonSpring>& spring() const noexcept { return spring_; }

  std::size_t body() const noexcept { return body_; }                // index of that body, if there is one
  double learnt_stiffness() const noexcept { return K_o_.value(); }  // of the masses that give [N/m]

 private:
  void learn(const StickPlane& plane, const Stick& stick, const Vec6& felt, double dt) noexcept;

  std::vector<StickSurface> surfaces_;
  std::optional<NortonSpring> spring_;
  std::size_t body_ = 0;
  SecantStiffness K_o_;
  double shift_ = 0;  // of c, from the middle of the plane's weights: a share of the length
};

}  // namespace palpate::physics
