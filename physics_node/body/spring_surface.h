#pragma once
// A closed surface of springs: what it is made of, and what of it never changes.
//
//   m x'' = F_ext - b x' + sum over neighbours (k (l - L) + c l') u + p dV/dx,     u towards the neighbour at distance l
//   p = p_0 + K (V_0 - V) / V_0        of what it is filled with, V the volume that it encloses
// A triangle of area A gives each of its three springs k = E t A / L^2, t the thickness of the membrane: of equilateral
// triangles a strip has the stiffness E t, and a Poisson ratio of 1/3. So a spring has the shares of two, and of one
// where these part.
//
// Source: Mendoza & Laugier, eqs. (1) and (2), EQUATIONS C-20 to C-23; k by area: van Gelder 1998.
// Deviation: the papers give every spring the same lambda = k L, whatever its triangles.

#include <cstdint>
#include <vector>

#include "physics_node/mesh/triangle_mesh.h"

namespace palpate::physics {

struct SurfaceSpring {
  std::array<Index, 2> node{};
  double k = 0;       // [N/m]
  double length = 0;  // at rest [m]
};

/// What it is made of, and what it is filled with.
struct Membrane {
  double modulus = 10e3;       // Young's [Pa]
  double thickness = 1e-3;     // [m]
  double density = 1000;       // [kg/m^3]
  double beta = 0;             // c / k of every spring [s]
  double drag = 0;             // b of every node [N s/m]
  double pressure = 0;         // p_0: above what is outside, while it encloses V_0 [Pa]
  double content_modulus = 0;  // K; 0: the pressure stays [Pa]
};

/// Else the pressure in it is that outside, whatever it encloses.
inline bool is_filled(const Membrane& membrane) noexcept {
  return membrane.pressure != 0 || membrane.content_modulus != 0;
}

/// What a triangle of this area gives each of its springs [N/m], and each of its nodes [kg].
inline double spring_share(const Membrane& membrane, double area, double length) noexcept {
  return membrane.modulus * membrane.thickness * area / (length * length);
}
inline double mass_share(const Membrane& membrane, double area) noexcept {
  return membrane.density * membrane.thickness * area / 3;
}

struct SpringSurface {
  TriangleMesh mesh;
  Membrane membrane;
  std::vector<SurfaceSpring> springs;  // by the smaller node
  std::vector<double> mass;            // of each node: a third of its triangles [kg]
  double volume = 0;                   // V_0 [m^3]
};

/// @param mesh  that check_surface() lets pass; its triangles are sorted by first corner
SpringSurface spring_surface(TriangleMesh mesh, const Membrane& membrane);

}  // namespace palpate::physics
