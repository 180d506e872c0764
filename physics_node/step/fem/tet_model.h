#pragma once
// What a body of tetrahedra is made of, and what of it never changes.

#include <vector>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

struct TetMaterial {
  double modulus = 10e3;        // Young's [Pa]
  double poisson_ratio = 0.45;  // below 0.5
  double density = 1000;        // [kg/m^3]
  bool nodal_pressure = true;   // false: plain elements, which lock near 0.5
};

struct TetModel {
  TetMesh mesh;                        // region: which of the materials
  std::vector<TetMaterial> materials;  // of all either with nodal pressure or without
  std::vector<bool> held;              // of each node; empty: none
  /// Of the damper: forces act as if the body were at u + beta v, which is stress from the rate of strain, beta times the
  /// modulus [s].
  double beta = 0;
};

/// Lumped: a quarter of each tetrahedron to each corner [kg]. (nodes)
std::vector<double> masses_of(const TetModel& model);

/// Slopes of the shape functions of corners 1, 2, 3 [1/m].
std::array<Vec3, 3> slopes_of(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept;

/// S = sum over corners of b b^T, by which a tetrahedron is stiffer the thinner it is.
struct TetSharpness {
  double largest = 0;  // eigenvalue [1/m^2]
  double trace = 0;    // [1/m^2]
};
TetSharpness sharpness_of(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept;

}  // namespace palpate::physics
