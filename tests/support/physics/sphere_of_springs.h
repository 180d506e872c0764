#pragma once
// A closed surface of springs with what tests ask of it.

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "physics_node/step/lattice/stable_step.h"
#include "physics_node/step/surface_mesh/surface_springs.h"
#include "tests/support/physics/made_sphere.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

inline constexpr double radius = 0.02;  // [m]
inline constexpr Membrane empty{.modulus = 50e3, .thickness = 2e-3, .density = 1100};
inline constexpr Membrane filled{
    .modulus = 50e3, .thickness = 2e-3, .density = 1100, .pressure = 300, .content_modulus = 20e3};

template <class Real = double>
struct Sphere {
  Sphere(const Membrane& membrane, int cuts) : Sphere(palpate::test::made_sphere(radius, cuts), membrane) {}
  Sphere(TriangleMesh mesh, const Membrane& membrane) : surface(spring_surface(std::move(mesh), membrane)) {
    for (const double mass : surface.mass) inverse_mass.push_back(1 / mass);
    springs = std::make_unique<SurfaceSprings<Real>>(surface, inverse_mass);
  }
  Index n() const { return static_cast<Index>(surface.mesh.nodes.size()); }
  double mass(Index node) const { return surface.mass[static_cast<std::size_t>(node)]; }
  Vec3 position(Index node) const {
    return surface.mesh.nodes[static_cast<std::size_t>(node)] + springs->displacement(node);
  }
  void stir(double displacement, double velocity) {
    Dice dice(3);
    for (Index node = 0; node < n(); ++node)
      springs->place(node, dice.within(displacement), dice.within(velocity));
  }
  /// Of the forces now, as one small step shows them.
  std::vector<Vec3> forces() {
    const double dt = 1e-9;
    std::vector<Vec3> before, forces;
    for (Index node = 0; node < n(); ++node) before.push_back(springs->velocity(node));
    SurfaceSprings<Real> copy(surface, inverse_mass);
    for (Index node = 0; node < n(); ++node)
      copy.place(node, springs->displacement(node), springs->velocity(node));
    copy.step({.dt = dt});
    for (Index node = 0; node < n(); ++node)
      forces.push_back(mass(node) * (copy.velocity(node) - before[static_cast<std::size_t>(node)]) / dt);
    return forces;
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (Index node = 0; node < n(); ++node) sum += mass(node) * springs->velocity(node);
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (Index node = 0; node < n(); ++node)
      sum += position(node).cross(mass(node) * springs->velocity(node));
    return sum;
  }
  double step_limit() {
    return stable_step({springs->omega2(), springs->gamma()}, Integrator::symplectic_euler);
  }

  SpringSurface surface;
  std::vector<double> inverse_mass;
  std::unique_ptr<SurfaceSprings<Real>> springs;
};

/// By differences of forces, all directions of all nodes at once.
inline double fastest_by_differences(Sphere<>& sphere) {
  const Index n = 3 * sphere.n();
  Eigen::MatrixXd hessian(n, n);
  const double h = 1e-7;
  for (Index column = 0; column < n; ++column) {
    const Index node = column / 3;
    const Vec3 u = sphere.springs->displacement(node);
    std::array<std::vector<Vec3>, 2> forces;
    for (const int side : {0, 1}) {
      Vec3 moved = u;
      moved[column % 3] += side == 0 ? -h : h;
      sphere.springs->place(node, moved, Vec3::Zero());
      forces[static_cast<std::size_t>(side)] = sphere.forces();
    }
    sphere.springs->place(node, u, Vec3::Zero());
    for (Index row = 0; row < n; ++row) {
      const auto at = static_cast<std::size_t>(row / 3);
      hessian(row, column) = (forces[0][at][row % 3] - forces[1][at][row % 3]) / (2 * h) /
                             std::sqrt(sphere.mass(row / 3) * sphere.mass(node));
    }
  }
  const Eigen::MatrixXd symmetric = 0.5 * (hessian + hessian.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace palpate::physics::test
