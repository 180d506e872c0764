#pragma once
// What a body of tetrahedra is made of, and what of it never changes.

#include <vector>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

struct TetMaterial {
  double modulus = 10e3;        // Young's [Pa]
  double poisson_ratio = 0.45;  // below 0.5
  double density = 1000;        // [kg/m^3]
  bool nodal_pressure =
      true;  // false: plain elements, which lock near 0.5; of no account in a mesh of second order
};

struct TetModel {
  TetMesh mesh;                        // region: which of the materials
  std::vector<TetMaterial> materials;  // of all either with nodal pressure or without
  std::vector<bool> held;              // of each node; empty: none
  /// Of the damper: stress from the rate of strain, beta times the modulus; see tet_damper.h [s].
  double beta = 0;
  /// Of its fastest vibration near rest, squared; 0: not known, and the bound of its elements has to do [1/s^2].
  double fastest_omega2 = 0;
};

/// The nodes of a tetrahedron: its corners, then its middles.
inline constexpr std::size_t most_tet_nodes = 10;
struct TetNodes {
  std::size_t n = 4;
  std::array<Index, most_tet_nodes> node{};
};
TetNodes nodes_of(const TetMesh& mesh, std::size_t tet) noexcept;

inline bool has_nodal_pressure(const TetModel& model) {
  return model.mesh.middles.empty() && model.materials.at(0).nodal_pressure;
}

/// Of a tetrahedron's mass at a corner and in the middle of an edge of second order: as the diagonal of the consistent mass has it.
/// Source: Hinton, Rock & Zienkiewicz 1976.
inline constexpr double corner_mass = 1.0 / 36, middle_mass = 4.0 / 27;

/// Lumped: of first order a quarter of each tetrahedron to each corner [kg]. (nodes)
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
