#include "render_node/gl/lit_program.h"

namespace palpate::render {
namespace {

const char* const vertex_source = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint flags;
layout(location = 3) in vec4 colour;
uniform mat4 clip_from_world;
uniform mat4 world_from_model;
out vec3 world;
out vec3 outward;
out vec3 albedo;
void main() {
  vec4 p = world_from_model * vec4(position, 1.0);
  world = p.xyz;
  outward = mat3(world_from_model) * normal;
  albedo = pow(colour.rgb, vec3(2.2));
  if ((flags & 1u) != 0u) albedo = albedo * 0.10 + vec3(0.004, 0.004, 0.012);  // yielded: dark
  if ((flags & 2u) != 0u) albedo = vec3(0.13, 0.008, 0.012);                   // broken: dark red
  gl_Position = clip_from_world * p;
}
)";

const char* const fragment_source = R"(
in vec3 world;
in vec3 outward;
in vec3 albedo;
uniform vec3 eye;
uniform vec3 key;
uniform vec3 fill;
uniform float gloss;
uniform float opacity;
uniform float darkness;
out vec4 pixel;
void main() {
  vec3 n = normalize(outward);
  if (!gl_FrontFacing) n = -n;
  vec3 v = normalize(eye - world);
  vec3 ambient = mix(vec3(0.13, 0.11, 0.10), vec3(0.30, 0.32, 0.36), 0.5 + 0.5 * n.z);
  float k = max((dot(n, key) + 0.15) / 1.15, 0.0);
  float f = max(dot(n, fill), 0.0);
  vec3 light = ambient + vec3(0.86, 0.82, 0.75) * k + vec3(0.13, 0.15, 0.19) * f;
  float shine = gloss * pow(max(dot(n, normalize(key + v)), 0.0), 24.0);
  float rim = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 3.0);
  vec3 seen = (albedo * light + vec3(shine)) * (1.0 - 0.45 * rim);
  seen = mix(seen, vec3(0.0), darkness);
  pixel = vec4(pow(seen, vec3(1.0 / 2.2)), opacity);
}
)";

Eigen::Vector3f in_world(const Camera& camera, const Vec3& of_viewer) {
  const Eigen::Matrix3d axes = camera.view().topLeftCorner<3, 3>();
  return (axes.transpose() * of_viewer.normalized()).cast<float>();
}

}  // namespace

LitProgram::LitProgram() : program_(vertex_source, fragment_source) {}

void LitProgram::begin(const Camera& camera) const {
  program_.use();
  program_.set("clip_from_world", Eigen::Matrix4f((camera.projection() * camera.view()).cast<float>()));
  program_.set("eye", Eigen::Vector3f(camera.eye().cast<float>()));
  program_.set("key", in_world(camera, {-0.55, 0.65, 0.62}));
  program_.set("fill", in_world(camera, {0.85, 0.05, 0.45}));
  darken(0);
}

void LitProgram::place(const Eigen::Matrix4f& world_from_model) const {
  program_.set("world_from_model", world_from_model);
}

void LitProgram::finish(float gloss, float opacity) const {
  program_.set("gloss", gloss);
  program_.set("opacity", opacity);
}

void LitProgram::darken(float share) const { program_.set("darkness", share); }

}  // namespace palpate::render
