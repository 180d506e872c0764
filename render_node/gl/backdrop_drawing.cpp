#include "render_node/gl/backdrop_drawing.h"

#include <epoxy/gl.h>

namespace palpate::render {
namespace {

const char* const gradient_vertex = R"(
out float up;
void main() {  // one triangle that covers the picture
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  up = 0.5 + 0.5 * p.y;
  gl_Position = vec4(p, 1.0, 1.0);  // behind everything
}
)";
const char* const gradient_fragment = R"(
in float up;
out vec4 pixel;
void main() {
  // Interleaved gradient noise (Jimenez 2014), against bands. Why not a sine of the place: it is most of a picture's cost where the
  // processor draws.
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  pixel = vec4(mix(vec3(0.70, 0.74, 0.79), vec3(0.94, 0.95, 0.97), smoothstep(0.0, 1.0, up)) + noise / 255.0, 1.0);
}
)";
const char* const plane_vertex = R"(
uniform mat4 clip_from_world;
uniform vec3 middle;
uniform vec3 along;
uniform vec3 upward;
uniform vec2 begin;
uniform float reach;
out vec2 across;
out vec2 place;
void main() {  // a strip of four corners
  across = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
  vec2 away = across * reach;
  vec3 p = middle + away.x * along + away.y * upward;
  place = begin + away;
  gl_Position = clip_from_world * vec4(p, 1.0);
}
)";
const char* const plane_fragment = R"(
in vec2 across;
in vec2 place;
uniform float cell;
out vec4 pixel;
void main() {
  vec2 q = place / cell;
  vec2 d = abs(fract(q - 0.5) - 0.5) / max(fwidth(q), vec2(1e-6));
  float line = 1.0 - clamp(min(d.x, d.y), 0.0, 1.0);
  float fade = 1.0 - smoothstep(0.35, 1.0, length(across));
  pixel = vec4(mix(vec3(0.60, 0.64, 0.70), vec3(0.40, 0.44, 0.50), line), fade * mix(0.30, 0.65, line));
}
)";

}  // namespace

BackdropDrawing::BackdropDrawing()
    : gradient_(gradient_vertex, gradient_fragment), plane_(plane_vertex, plane_fragment) {}

void BackdropDrawing::draw_gradient() const {
  gradient_.use();
  array_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void BackdropDrawing::draw_plane(const Camera& camera, const Vec3& middle, const Vec3& point,
                                 const Vec3& normal, double cell, double reach) const {
  // The grid of a plane across z counts along x and y, any other along the horizontal and up the slope.
  const Vec3 level = normal.cross(Vec3::UnitZ());
  const Vec3 along = level.norm() < 1e-6 ? Vec3(Vec3::UnitX()) : Vec3(-level.normalized());
  const Vec3 upward = level.norm() < 1e-6 ? Vec3(Vec3::UnitY()) : Vec3(along.cross(normal).normalized());
  const Vec3 nearest = middle - normal * normal.dot(middle - point);
  plane_.use();
  plane_.set("clip_from_world", Eigen::Matrix4f((camera.projection() * camera.view()).cast<float>()));
  plane_.set("middle", Eigen::Vector3f(nearest.cast<float>()));
  plane_.set("along", Eigen::Vector3f(along.cast<float>()));
  plane_.set("upward", Eigen::Vector3f(upward.cast<float>()));
  plane_.set("begin", Eigen::Vector2f(static_cast<float>(along.dot(nearest)),
                                      static_cast<float>(upward.dot(nearest))));
  plane_.set("reach", static_cast<float>(reach));
  plane_.set("cell", static_cast<float>(cell));
  array_.bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace palpate::render
