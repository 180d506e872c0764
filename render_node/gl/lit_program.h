#pragma once
// The one way surfaces are lit: a hemispheric ambient light from the sky (world z) and the ground, a soft key light from the
// upper left of the viewer and a weak fill from the right, a little gloss, and silhouettes slightly darker.

#include <Eigen/Core>

#include "render_node/gl/program.h"
#include "render_node/view/camera.h"

namespace palpate::render {

// Attribute locations of the vertex shader.
inline constexpr unsigned at_position = 0;  // vec3, model space
inline constexpr unsigned at_normal = 1;    // vec3, model space, unit
inline constexpr unsigned at_flags = 2;     // uint, vertex_yielded | vertex_broken
inline constexpr unsigned at_colour = 3;    // vec4, sRGB

class LitProgram {
 public:
  LitProgram();

  /// Makes it current, with the lights fixed to the viewer.
  void begin(const Camera& camera) const;
  void place(const Eigen::Matrix4f& world_from_model) const;
  /// @param gloss  strength of the highlight, 0..1  @param opacity  1: opaque
  void finish(float gloss, float opacity) const;
  /// @param share  1: plain black instead of light, for wires
  void darken(float share) const;

 private:
  Program program_;
};

}  // namespace palpate::render
