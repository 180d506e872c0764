#pragma once
// A smooth sphere pressed into a block, which stands on its lower face: a quarter of both, in steps of the depth, each to rest.
//
// The sphere meets the faces of the surface at 4 x 4 points each, spread bilinearly to their nodes, never only nodes:
//   J = min(k g dt, m_eff g / (16 dt)),   k = 40 E/h a/16,   m_eff = 1/sum(w^2/m)
// g how deep the point is in the sphere, a the area of the face at rest, h the edge of a cell.

#include <optional>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/element_kinds.h"

namespace palpate::bench {

struct SpherePress {
  static constexpr double modulus = 10e3, density = 1000;   // [Pa, kg/m^3]
  static constexpr double breadth = 0.1, height = 0.06;     // of the whole block [m]
  static constexpr double deepest = 0.005, stage = 0.0005;  // of the sphere, and by how much it goes on [m]
  double radius = 0.005;                                    // [m]
  double edge = 0.0025;                                     // of a cell [m]
  double poisson_ratio = 0.45;                              // of springs: their own
  ElementModel model = ElementModel::fem;
  HourglassKind hourglass = HourglassKind::physical;
};

struct Pressed {
  std::vector<double> force;             // of the whole block, at rest after each stage [N]
  std::optional<double> least_corner_J;  // of all steps; of cells only
  bool at_rest = true;                   // after every stage
  std::int64_t cells = 0, steps = 0;
  double cpu_s = 0;

  bool is_monotone() const;
};

/// Cost: 2 s at 2.5 mm and nu 0.45, and so on with the fourth power of 1 / edge.
Pressed press(const SpherePress& how);

}  // namespace palpate::bench
