#pragma once
// The one way surfaces are lit: a hemispheric ambient light from the sky (world z) and the ground, a soft key light
// from the upper left of the viewer and a weak fill from the right, a little gloss, and silhouettes slightly darker.
// Colours are lit as squares of what is shown (nearly the light they stand for). Light and dark: a vertex is the darker,
// the more of its live elements have yielded.

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "render_node/gl/program.h"
#include "render_node/view/camera.h"
#include "render_node/view/section_cut.h"

namespace palpate::render {

// Attribute locations of the vertex shader.
inline constexpr unsigned at_position = 0;  // vec3, model space
inline constexpr unsigned at_normal = 1;    // vec3, model space, unit
inline constexpr unsigned at_flags = 2;     // uint, flags of VertexBlock
inline constexpr unsigned at_colour = 3;    // vec4, as shown
inline constexpr unsigned at_rest = 4;      // vec3, where it lies without any load
inline constexpr unsigned at_field = 5;     // float, what colours show

/// Where the light is computed. Facets of about a pixel look the same lit at their vertices, at a third of the cost in
/// software; but only pixels know which side of an open surface they show. Points are drawn as beads, that is as small
/// balls that face the viewer; lines are not lit, their colour says enough.
enum class Lighting { at_pixels, at_vertices, as_beads, as_lines };

/// A tool near a surface. What lies within about its radius is darker, the nearer the darker: it shows how far off
/// the tool is, and the dent in which it lies. Where it presses there is a ring, too.
struct Touch {
  Eigen::Vector3f at = Eigen::Vector3f::Zero();  // [m]
  float radius = 0;                              // > 0 [m]
  bool presses = false;
  friend bool operator==(const Touch&, const Touch&) = default;
};
/// So many radii from it nothing is darker, to the bit.
inline constexpr float touch_reach = 2.7F;
inline constexpr std::size_t most_touches = 4;  // further ones are left out

class LitProgram {
 public:
  explicit LitProgram(Lighting lighting);

  /// Makes it current, with the lights fixed to the viewer, fully opaque.
  void begin(const Camera& camera) const;
  void place(const Eigen::Matrix4f& world_from_model) const;
  /// @param gloss  strength of the highlight, 0..1  @param opacity  1: opaque
  void finish(float gloss, float opacity) const;
  /// @param share  of white in the colour, 0: none. Lines over a pale surface are easily seen.
  void pale(float share) const;
  /// How dark elements are shown that have yielded: 1 nearly black, less where colours are to be told apart.
  void shade(float share) const;
  /// Coloured by how far a vertex is from rest, up to so much [m]; 0, as after begin(): in its own colour.
  void colour_by_way(float most) const;
  /// Coloured by the field of a vertex, up to so much, likewise.
  void colour_by_field(float most) const;
  /// What rests beyond the plane is not drawn (section_cut.h), while GL_CLIP_DISTANCE0 is enabled; all is after
  /// begin().
  void cut_open(const Eigen::Vector4f& cut) const;
  /// By tools; none after begin().
  void touched(std::span<const Touch> touches) const;
  /// Of beads. @param radius [m]  @param height  of the picture [px]
  void size_beads(const Camera& camera, float radius, int height) const;

 private:
  Program program_;
};

}  // namespace palpate::render
