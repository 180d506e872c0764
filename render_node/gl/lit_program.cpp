#include "render_node/gl/lit_program.h"

#include <algorithm>
#include <array>
#include <string>

namespace palpate::render {
namespace {

// What a point of the surface sends to the eye, as shown.
const std::string light_source = R"(
uniform vec3 eye;
uniform vec3 key;
uniform vec3 fill;
uniform float gloss;
uniform float opacity;
uniform float paleness;
uniform vec4 touch[4];  // where, and how large
uniform vec4 ring;      // 1 each: drawn
uniform float touches;
float shadow(vec3 p) {
  float light = 1.0;
  for (int i = 0; i < 4; ++i) {
    if (float(i) >= touches) break;
    float r = distance(p, touch[i].xyz) / touch[i].w;
    if (r > 2.69) continue;  // touch_reach: there it would be a third of a thousandth
    light *= 1.0 - 0.5 * exp(-r * r);
    light *= 1.0 - 0.4 * ring[i] * (1.0 - smoothstep(0.05, 0.12, abs(r - 1.25)));
  }
  return light;
}
vec4 lit(vec3 n, vec3 v, vec3 albedo, vec3 p) {
  vec3 ambient = mix(vec3(0.12, 0.10, 0.09), vec3(0.29, 0.31, 0.35), 0.5 + 0.5 * n.z);
  float k = max((dot(n, key) + 0.12) / 1.12, 0.0);
  float f = max(dot(n, fill), 0.0);
  vec3 light = shadow(p) * (ambient + vec3(0.88, 0.84, 0.77) * k + vec3(0.13, 0.15, 0.19) * f);
  float h = max(dot(n, normalize(key + v)), 0.0);
  float h8 = h * h * h * h;
  h8 *= h8;
  float away = 1.0 - clamp(dot(n, v), 0.0, 1.0);
  vec3 seen = (albedo * light + vec3(gloss * h8 * h8 * h8)) * (1.0 - 0.45 * away * away * away);
  float veil = mix(opacity, 1.0, away * away * away);  // what is seen along itself hides more
  return vec4(mix(sqrt(seen), vec3(0.95, 0.96, 0.97), paleness), opacity < 1.0 ? veil : 1.0);
}
)";

const std::string vertex_source = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint flags;
layout(location = 3) in vec4 colour;
layout(location = 4) in vec3 rest;
layout(location = 5) in float field;
uniform float most_way;
uniform float most_field;
uniform mat4 clip_from_world;
uniform mat4 world_from_model;
uniform float shading;
uniform vec4 cut;
void take_away() { gl_ClipDistance[0] = cut.w - dot(cut.xyz, rest); }
// As ColourScale has it: its own colour, yellow, orange, red, violet.
vec3 by_scale(vec3 own, float share) {
  vec3 yellow = vec3(1.00, 0.86, 0.30), orange = vec3(0.96, 0.50, 0.12);
  vec3 red = vec3(0.78, 0.12, 0.16), violet = vec3(0.40, 0.06, 0.46);
  float s = 4.0 * clamp(share, 0.0, 1.0);
  if (s < 1.0) return mix(own, yellow, s);
  if (s < 2.0) return mix(yellow, orange, s - 1.0);
  if (s < 3.0) return mix(orange, red, s - 2.0);
  return mix(red, violet, s - 3.0);
}
vec3 albedo_here() {
  vec3 shown = colour.rgb;
  if (most_way > 0.0) shown = by_scale(shown, distance(position, rest) / most_way);
  if (most_field > 0.0) shown = by_scale(shown, field / most_field);
  vec3 light = shown * shown;
  vec3 dark = light * 0.08 + vec3(0.004, 0.004, 0.010);
  return mix(light, dark, shading * float(flags >> 2u) / 63.0);  // light: elastic, dark: yielded
}
)";

const std::string vertex_for_pixels = R"(
out vec3 world;
out vec3 outward;
out vec3 albedo;
void main() {
  vec4 p = world_from_model * vec4(position, 1.0);
  world = p.xyz;
  outward = mat3(world_from_model) * normal;
  albedo = albedo_here();
  gl_Position = clip_from_world * p;
  take_away();
}
)";
const std::string pixel_lit = R"(
in vec3 world;
in vec3 outward;
in vec3 albedo;
out vec4 pixel;
void main() {
  vec3 n = normalize(outward);
  pixel = lit(gl_FrontFacing ? n : -n, normalize(eye - world), albedo, world);
}
)";

const std::string vertex_lit = R"(
out vec4 seen;
void main() {
  vec4 p = world_from_model * vec4(position, 1.0);
  seen = lit(mat3(world_from_model) * normal, normalize(eye - p.xyz), albedo_here(), p.xyz);
  gl_Position = clip_from_world * p;
  take_away();
}
)";
const std::string pixel_passed_on = R"(
in vec4 seen;
out vec4 pixel;
void main() { pixel = seen; }
)";

const std::string vertex_bead = R"(
uniform float bead_size;
out vec3 world;
out vec3 albedo;
void main() {
  vec4 p = world_from_model * vec4(position, 1.0);
  world = p.xyz;
  albedo = albedo_here();
  gl_Position = clip_from_world * p;
  gl_PointSize = max(bead_size / gl_Position.w, 2.0);
  take_away();
}
)";
const std::string pixel_bead = R"(
uniform vec3 to_right;
uniform vec3 upwards;
uniform vec3 to_viewer;
in vec3 world;
in vec3 albedo;
out vec4 pixel;
void main() {
  vec2 q = 2.0 * gl_PointCoord - 1.0;
  float up2 = 1.0 - dot(q, q);
  if (up2 < 0.0) discard;
  vec3 n = q.x * to_right - q.y * upwards + sqrt(up2) * to_viewer;
  pixel = lit(n, normalize(eye - world), albedo, world);
}
)";

const std::string vertex_line = R"(
out vec4 seen;
void main() {
  seen = vec4(sqrt(0.42 * albedo_here()), 1.0);
  gl_Position = clip_from_world * world_from_model * vec4(position, 1.0);
  take_away();
}
)";

Program program_for(Lighting lighting) {
  if (lighting == Lighting::as_beads) return Program(vertex_source + vertex_bead, light_source + pixel_bead);
  if (lighting == Lighting::as_lines) return Program(vertex_source + vertex_line, pixel_passed_on);
  if (lighting == Lighting::at_vertices)
    return Program(vertex_source + light_source + vertex_lit, pixel_passed_on);
  return Program(vertex_source + vertex_for_pixels, light_source + pixel_lit);
}

Eigen::Vector3f in_world(const Camera& camera, const Vec3& of_viewer) {
  const Eigen::Matrix3d axes = camera.view().topLeftCorner<3, 3>();
  return (axes.transpose() * of_viewer.normalized()).cast<float>();
}

}  // namespace

LitProgram::LitProgram(Lighting lighting) : program_(program_for(lighting)) {}

void LitProgram::begin(const Camera& camera) const {
  program_.use();
  program_.set("clip_from_world", Eigen::Matrix4f((camera.projection() * camera.view()).cast<float>()));
  program_.set("eye", Eigen::Vector3f(camera.eye().cast<float>()));
  program_.set("key", in_world(camera, {-0.55, 0.65, 0.62}));
  program_.set("fill", in_world(camera, {0.85, 0.05, 0.45}));
  program_.set("to_right", in_world(camera, Vec3::UnitX()));
  program_.set("upwards", in_world(camera, Vec3::UnitY()));
  program_.set("to_viewer", in_world(camera, Vec3::UnitZ()));
  touched({});
  finish(0, 1);
  pale(0);
  shade(1);
  colour_by_way(0);
  colour_by_field(0);
  cut_open(no_cut());
}

void LitProgram::place(const Eigen::Matrix4f& world_from_model) const {
  program_.set("world_from_model", world_from_model);
}

void LitProgram::finish(float gloss, float opacity) const {
  program_.set("gloss", gloss);
  program_.set("opacity", opacity);
}

void LitProgram::pale(float share) const { program_.set("paleness", share); }
void LitProgram::shade(float share) const { program_.set("shading", share); }

void LitProgram::colour_by_way(float most) const { program_.set("most_way", most); }

void LitProgram::colour_by_field(float most) const { program_.set("most_field", most); }

void LitProgram::cut_open(const Eigen::Vector4f& cut) const { program_.set("cut", cut); }

void LitProgram::touched(std::span<const Touch> touches) const {
  static constexpr std::array<const char*, most_touches> names = {"touch[0]", "touch[1]", "touch[2]",
                                                                  "touch[3]"};
  const std::size_t n = std::min(touches.size(), most_touches);
  Eigen::Vector4f rings = Eigen::Vector4f::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector4f where;
    where << touches[i].at, touches[i].radius;
    program_.set(names[i], where);
    rings[static_cast<Eigen::Index>(i)] = touches[i].presses ? 1.0F : 0.0F;
  }
  program_.set("ring", rings);
  program_.set("touches", static_cast<float>(n));
}

void LitProgram::size_beads(const Camera& camera, float radius, int height) const {
  // A length l at the distance w of clip space covers l / w * P_11 * height / 2 pixels.
  const auto pixels_per_metre = static_cast<float>(camera.projection()(1, 1) * height / 2);
  program_.set("bead_size", 2 * radius * pixels_per_metre);
}

}  // namespace palpate::render
