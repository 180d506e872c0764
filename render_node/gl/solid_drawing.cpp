#include "render_node/gl/solid_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace palpate::render {
namespace {

constexpr std::uint32_t n_sides = 40;

// A ring pair stands where the outline has an edge: each segment brings its own normals, unless the outline is smooth.
void add_segment(const Ring& a, const Ring& b, const Eigen::Vector2f& normal_a,
                 const Eigen::Vector2f& normal_b, std::vector<SolidVertex>& vertices,
                 std::vector<std::uint32_t>& indices) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t s = 0; s <= n_sides; ++s) {
    const float angle =
        2.0F * std::numbers::pi_v<float> * static_cast<float>(s) / static_cast<float>(n_sides);
    const float c = std::cos(angle), d = std::sin(angle);
    vertices.push_back(
        {{a.radius * c, a.radius * d, a.z}, {normal_a.x() * c, normal_a.x() * d, normal_a.y()}});
    vertices.push_back(
        {{b.radius * c, b.radius * d, b.z}, {normal_b.x() * c, normal_b.x() * d, normal_b.y()}});
  }
  for (std::uint32_t s = 0; s < n_sides; ++s) {
    const std::uint32_t v = first + 2 * s;
    indices.insert(indices.end(), {v, v + 2, v + 1, v + 1, v + 2, v + 3});
  }
}

Eigen::Vector2f segment_normal(const Ring& a, const Ring& b) {
  const Eigen::Vector2f n(b.z - a.z, a.radius - b.radius);
  return n.norm() > 0 ? Eigen::Vector2f(n.normalized()) : Eigen::Vector2f(1, 0);
}

// Smooth where two segments meet at less than 35 degrees.
Eigen::Vector2f shared_normal(const Eigen::Vector2f& own, const Eigen::Vector2f& other) {
  return own.dot(other) > 0.82F ? Eigen::Vector2f((own + other).normalized()) : own;
}

}  // namespace

std::vector<Ring> stick_outline(float tip_radius, float length) {
  std::vector<Ring> outline;
  // A ball for a tip, then a thinner shaft, so that the tip does not hide what it presses; then the handle.
  constexpr int n = 12;
  constexpr float ball = 0.85F * std::numbers::pi_v<float>;
  for (int i = 0; i <= n; ++i) {
    const float angle = ball * static_cast<float>(i) / static_cast<float>(n);
    outline.push_back({tip_radius * std::sin(angle), tip_radius * (1 - std::cos(angle))});
  }
  const float shaft = tip_radius * std::sin(ball);
  const float neck = std::max(0.45F * length, 4 * tip_radius);
  const float handle = 0.9F * tip_radius;
  outline.push_back({shaft, neck});
  outline.push_back({handle, neck + 1.5F * tip_radius});
  outline.push_back({handle, length});
  outline.push_back({0, length});
  return outline;
}

std::vector<Ring> capsule_outline(float radius, float length) {
  std::vector<Ring> outline;
  constexpr int n = 8;
  const auto round_end = [&](float from, float middle) {
    for (int i = 0; i <= n; ++i) {
      const float angle =
          from + 0.5F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
      outline.push_back({radius * std::sin(angle), middle - radius * std::cos(angle)});
    }
  };
  round_end(0, 0);
  round_end(0.5F * std::numbers::pi_v<float>, length);
  return outline;
}

std::vector<Ring> cylinder_outline(float radius, float length) {
  return {{0, 0}, {radius, 0}, {radius, length}, {0, length}};
}

std::vector<Ring> cone_outline(float radius, float length) { return {{0, 0}, {radius, length}, {0, length}}; }

std::vector<Ring> needle_outline(float radius, float length) {
  return {{0, 0}, {radius, std::min(4 * radius, length)}, {radius, length}, {0, length}};
}

std::vector<Ring> arrow_outline(float radius, float length) {
  const float head = std::min(5 * radius, 0.6F * length);
  return {{0, 0}, {radius, 0}, {radius, length - head}, {2.4F * radius, length - head}, {0, length}};
}

Eigen::Matrix4f pose_along(const Eigen::Vector3d& at, const Eigen::Vector3d& axis) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  pose.translation() = at;
  return pose.matrix().cast<float>();
}

SolidDrawing::SolidDrawing() {
  array_.bind();
  vertices_.bind();
  glVertexAttribPointer(at_position, 3, GL_FLOAT, GL_FALSE, sizeof(SolidVertex), nullptr);
  glVertexAttribPointer(at_normal, 3, GL_FLOAT, GL_FALSE, sizeof(SolidVertex),
                        reinterpret_cast<const void*>(offsetof(SolidVertex, normal)));
  glEnableVertexAttribArray(at_position);
  glEnableVertexAttribArray(at_normal);
}

void SolidDrawing::shape(const std::vector<Ring>& outline) {
  std::vector<SolidVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Eigen::Vector2f> normals;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i)
    normals.push_back(segment_normal(outline[i], outline[i + 1]));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto& before = normals[i == 0 ? 0 : i - 1];
    const auto& after = normals[std::min(i + 1, normals.size() - 1)];
    add_segment(outline[i], outline[i + 1], shared_normal(normals[i], before),
                shared_normal(normals[i], after), vertices, indices);
  }
  upload(vertices, indices);
}

void SolidDrawing::upload(std::span<const SolidVertex> vertices, std::span<const std::uint32_t> indices) {
  array_.bind();
  vertices_.upload(vertices);
  indices_.upload(indices);
  n_indices_ = indices.size();
  box_.setEmpty();
  for (const SolidVertex& vertex : vertices) box_.extend(Eigen::Vector3f(vertex.position.data()));
}

void SolidDrawing::shape_box(const Eigen::Vector3f& size) {
  std::vector<SolidVertex> vertices;
  std::vector<std::uint32_t> indices;
  const Eigen::Vector3f half(0.5F * size.x(), 0.5F * size.y(), 0.5F * size.z());
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0F, 1.0F}) {
      const Eigen::Vector3f normal = side * Eigen::Vector3f::Unit(axis);
      const Eigen::Vector3f u = Eigen::Vector3f::Unit((axis + 1) % 3), v = normal.cross(u);
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const auto& [a, b] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        const Eigen::Vector3f at =
            half.cwiseProduct(normal + a * u + b * v) + half.z() * Eigen::Vector3f::UnitZ();
        vertices.push_back({{at.x(), at.y(), at.z()}, {normal.x(), normal.y(), normal.z()}});
      }
      indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  upload(vertices, indices);
}

namespace {

/// Prisms along y, of outlines in the plane of x and z.
class Prisms {
 public:
  using Outline = std::array<std::array<float, 2>, 4>;  // x, z; clockwise where x is to the right and z up

  void add(const Outline& outline, float low, float high) {
    std::array<std::array<float, 3>, 4> left, right;
    for (std::size_t n = 0; n < 4; ++n)
      left[n] = {outline[n][0], low, outline[n][1]}, right[n] = {outline[n][0], high, outline[n][1]};
    face(left, {0, -1, 0});
    face(right, {0, 1, 0});
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t m = (n + 1) % 4;
      const float dx = left[m][0] - left[n][0], dz = left[m][2] - left[n][2], way = std::hypot(dx, dz);
      if (way > 0) face(std::array{left[n], left[m], right[m], right[n]}, {-dz / way, 0, dx / way});
    }
  }

  std::vector<SolidVertex> vertices;
  std::vector<std::uint32_t> indices;

 private:
  void face(std::span<const std::array<float, 3>> corners, const std::array<float, 3>& normal) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const auto& corner : corners) vertices.push_back({corner, normal});
    for (std::uint32_t n = 2; n < corners.size(); ++n)
      indices.insert(indices.end(), {first, first + n - 1, first + n});
  }
};

}  // namespace

void SolidDrawing::shape_blade(float length, float angle) {
  const float c = length * std::cos(angle), s = length * std::sin(angle);
  const float top = c + 0.3F * length, back = 0.25F * c, thick = 0.02F * length;
  const float neck = std::min(0.25F * length, s + back), end = top + 3 * length;
  Prisms prisms;
  prisms.add({{{0, 0}, {-s, c}, {-s, top}, {back, top}}}, -thick, thick);
  prisms.add({{{back - neck, top}, {back - neck, end}, {back, end}, {back, top}}}, -2 * thick, 2 * thick);
  upload(prisms.vertices, prisms.indices);
}

void SolidDrawing::shape_scissor(float length, float offset, bool other) {
  const float top = 0.15F * length, back = 0.12F * length, end = 2.5F * length, half = 0.05F * length;
  const float thick = 0.04F * length;
  const Prisms::Outline blade = {
      {{-offset, -length}, {-offset, top}, {back, top}, {0.6F * back, -0.6F * length}}};
  const Prisms::Outline arm = {{{-half, top}, {-half, end}, {half, end}, {half, top}}};
  Prisms prisms;
  for (const Prisms::Outline& outline : {blade, arm}) {
    Prisms::Outline own = outline;
    if (other)
      for (std::size_t n = 0; n < 4; ++n) own[n] = {-outline[(4 - n) % 4][0], outline[(4 - n) % 4][1]};
    prisms.add(own, other ? -thick : 0, other ? 0 : thick);
  }
  upload(prisms.vertices, prisms.indices);
}

void SolidDrawing::draw(const LitProgram& program, const Eigen::Matrix4f& pose,
                        const Eigen::Vector3f& rgb) const {
  program.place(pose);
  array_.bind();
  indices_.bind();
  glVertexAttribI1ui(at_flags, 0);
  glVertexAttrib4f(at_colour, rgb.x(), rgb.y(), rgb.z(), 1);
  glEnable(GL_CULL_FACE);  // all shapes are closed
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(n_indices_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::render
