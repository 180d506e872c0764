#pragma once
// A rigid shape pressed by given forces into a block that stands on its lower face, to rest at each: a quarter of both.

#include <vector>

#include "common/scene/element_kinds.h"
#include "physics_node/contact/rigid_shape.h"

namespace palpate::bench {

struct ShapePress {
  static constexpr double modulus = 10e3, density = 1000;  // [Pa, kg/m^3]
  physics::RigidShape shape = physics::RigidShape::sphere(0.005);
  double edge = 0.00125;        // of a cell [m]
  double poisson_ratio = 0.45;  // of springs: their own
  ElementModel model = ElementModel::fem;
  double breadth = 0.04, height = 0.02;  // of the whole block [m]
  std::vector<double> forces{};          // of the whole, growing [N]
  double share = 0.6;                    // of the stable step that a step takes
};

struct ShapePressed {
  std::vector<double> depth, area,
      overlap;  // at rest: see FacePress; the area is that of the whole [m], [m^2]
  bool at_rest = true;
  std::int64_t cells = 0, steps = 0;
  double cpu_s = 0, press_s = 0;  // all, and of the contact [s]
};

ShapePressed press(const ShapePress& how);

/// Depth on a half space: that on the block less what the block is stiffer by, c F / L for blocks of one shape and breadth L, which is
/// twice the difference between this block and one twice as large, both on cells twice as large [m].
std::vector<double> depth_on_half_space(const ShapePress& how, const ShapePressed& pressed);

/// What the springs of a voxel lattice have for Poisson's ratio.
inline constexpr double springs_poisson_ratio = 0.25;

}  // namespace palpate::bench
