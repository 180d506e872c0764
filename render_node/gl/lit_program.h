#pragma once
// The one way surfaces are lit: a hemispheric ambient light from the sky (world z) and the ground, a soft key light
// from the upper left of the viewer and a weak fill from the right, a little gloss, and silhouettes slightly darker.
// Colours are lit as squares of what is shown (nearly the light they stand for).

#include <Eigen/Core>

#include "render_node/gl/program.h"
#include "render_node/view/camera.h"

namespace palpate::render {

// Attribute locations of the vertex shader.
inline constexpr unsigned at_position = 0;  // vec3, model space
inline constexpr unsigned at_normal = 1;    // vec3, model space, unit
inline constexpr unsigned at_flags = 2;     // uint, vertex_yielded | vertex_broken
inline constexpr unsigned at_colour = 3;    // vec4, as shown

/// Where the light is computed. Facets of about a pixel look the same lit at their vertices, at a third of the cost in
/// software; but only pixels know which side of an open surface they show.
enum class Lighting { at_pixels, at_vertices };

class LitProgram {
 public:
  explicit LitProgram(Lighting lighting);

  /// Makes it current, with the lights fixed to the viewer, fully opaque.
  void begin(const Camera& camera) const;
  void place(const Eigen::Matrix4f& world_from_model) const;
  /// @param gloss  strength of the highlight, 0..1  @param opacity  1: opaque
  void finish(float gloss, float opacity) const;
  /// @param share  0: lit, 1: plain black, for wires
  void darken(float share) const;

 private:
  Program program_;
};

}  // namespace palpate::render
