// The step of a surface of uneven triangles: what is found is the fastest vibration, and no bound far above it.
#include "physics_node/step/surface_mesh/surface_spectrum.h"

#include <gtest/gtest.h>

#include "tests/support/physics/sphere_of_springs.h"

namespace palpate::physics::test {
namespace {

/// Nodes moved along the sphere by up to 0.3 of an edge.
TriangleMesh uneven(int cuts) {
  TriangleMesh mesh = palpate::test::made_sphere(radius, cuts);
  const double edge = (mesh.nodes[static_cast<std::size_t>(mesh.triangles[0][1])] -
                       mesh.nodes[static_cast<std::size_t>(mesh.triangles[0][0])])
                          .norm();
  Dice dice(7);
  for (Vec3& x : mesh.nodes) x = radius * (x + dice.within(0.3 * edge)).normalized();
  return mesh;
}

TEST(SurfaceSpectrum, IsTheFastestVibrationAndTheBoundByNodeIsNot) {
  for (const Membrane& membrane : {empty, filled}) {
    Sphere sphere(uneven(1), membrane);
    const double found = fastest_by_differences(sphere);
    const StiffestMode mode = stiffest_mode_of_surface(sphere.surface, sphere.inverse_mass);
    EXPECT_GE(mode.omega2, found * (1 - 1e-4));
    EXPECT_LE(mode.omega2, found * 1.02);
    EXPECT_GT(sphere.springs->omega2(), 1.15 * found);
  }
}

TEST(SurfaceSpectrum, HeldNodesDoNotVibrate) {
  Sphere sphere(uneven(1), filled);
  const double free = stiffest_mode_of_surface(sphere.surface, sphere.inverse_mass).omega2;
  const auto fastest =
      static_cast<std::size_t>(std::ranges::max_element(sphere.inverse_mass) - sphere.inverse_mass.begin());
  sphere.inverse_mass[fastest] = 0;
  EXPECT_LT(stiffest_mode_of_surface(sphere.surface, sphere.inverse_mass).omega2, 0.99 * free);
  std::ranges::fill(sphere.inverse_mass, 0.0);
  EXPECT_EQ(stiffest_mode_of_surface(sphere.surface, sphere.inverse_mass).omega2, 0);
}

TEST(SurfaceSpectrum, JustBelowItsStepASurfaceStaysAndJustAboveItDoesNot) {
  Membrane damped = filled;
  damped.pressure = 0;
  damped.beta = 2e-5, damped.drag = 1e-3;
  Membrane elastic = damped;
  elastic.beta = elastic.drag = 0;
  for (const Membrane& membrane : {elastic, damped})
    for (const double share : {0.98, 1.05}) {
      Sphere sphere(uneven(2), membrane);
      sphere.stir(1e-7, 0);
      const double before = sphere.springs->energies(Vec3::Zero()).elastic;
      const double dt = share * stable_step(stiffest_mode_of_surface(sphere.surface, sphere.inverse_mass),
                                            Integrator::symplectic_euler);
      double largest = 0;
      for (int n = 0; n < 4000 && largest < 1e4 * before; ++n) {
        sphere.springs->step({.dt = dt});
        largest = std::max(largest, sphere.springs->energies(Vec3::Zero()).elastic);
      }
      if (share < 1)
        EXPECT_LT(largest, 50 * before) << membrane.beta;
      else
        EXPECT_GT(largest, 1000 * before) << membrane.beta;
    }
}

}  // namespace
}  // namespace palpate::physics::test
