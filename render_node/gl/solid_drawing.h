#pragma once
// Bodies of revolution about z, and boxes: tools and the force arrow.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render_node/gl/buffer.h"
#include "render_node/gl/lit_program.h"

namespace palpate::render {

/// One ring of the outline, from the bottom up.
struct Ring {
  float radius = 0, z = 0;
};

/// A stick that ends in a half sphere whose lowest point is the origin; it widens to a handle. [m]
std::vector<Ring> stick_outline(float tip_radius, float length);
/// Axis from 0 to `length`, round ends beyond.
std::vector<Ring> capsule_outline(float radius, float length);
/// From the origin up, with sharp edges.
std::vector<Ring> cylinder_outline(float radius, float length);
/// Its apex is the origin.
std::vector<Ring> cone_outline(float radius, float length);
/// From its sharp tip, the origin, up. [m]
std::vector<Ring> needle_outline(float radius, float length);
/// An arrow from the origin to (0, 0, length). [m]
std::vector<Ring> arrow_outline(float radius, float length);

/// World from a model whose z axis becomes `axis` and whose origin becomes `at`.
Eigen::Matrix4f pose_along(const Eigen::Vector3d& at, const Eigen::Vector3d& axis);

struct SolidVertex {
  std::array<float, 3> position, normal;
};

class SolidDrawing {
 public:
  SolidDrawing();
  void shape(const std::vector<Ring>& outline);
  /// A box that stands on the origin. [m]
  void shape_box(const Eigen::Vector3f& size);
  /// A blade in the plane of x and z, whose edge goes from the origin up and toward -x. [m] @param angle  from z [rad]
  void shape_blade(float length, float angle);
  /// A blade of scissors in the plane of x and z, closed: its pivot is the origin, its edge points along -z and looks
  /// toward -x, the other's mirrored. [m] @param offset  by which the edge passes the pivot
  void shape_scissor(float length, float offset, bool other);
  void draw(const LitProgram& program, const Eigen::Matrix4f& pose, const Eigen::Vector3f& rgb) const;
  const Eigen::AlignedBox3f& box() const noexcept { return box_; }  // round its shape

 private:
  void upload(std::span<const SolidVertex> vertices, std::span<const std::uint32_t> indices);

  VertexArray array_;
  Buffer vertices_{Buffer::Kind::vertices};
  Buffer indices_{Buffer::Kind::indices};
  std::size_t n_indices_ = 0;
  Eigen::AlignedBox3f box_;
};

}  // namespace palpate::render
