// Laws of a closed surface of springs: forces from energy, momentum, books to rounding, closed forms, and its stable
// step.
#include "physics_node/step/surface_mesh/surface_springs.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>

#include "physics_node/step/lattice/stable_step.h"
#include "physics_node/step/team.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/sphere_of_springs.h"

namespace palpate::physics::test {
namespace {

TEST(SurfaceSprings, ForceIsMinusTheGradientOfEnergy) {
  Sphere sphere(filled, 1);
  sphere.stir(2e-3, 0);
  const auto forces = sphere.forces();
  const double h = 1e-8;
  double largest = 0, worst = 0;
  for (Index node = 0; node < sphere.n(); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 u = sphere.springs->displacement(node);
      const auto energy_at = [&](double d) {
        Vec3 moved = u;
        moved[axis] += d;
        sphere.springs->place(node, moved, Vec3::Zero());
        const Energies e = sphere.springs->energies(Vec3::Zero());
        return e.elastic + e.gravitational;
      };
      const double slope = (energy_at(h) - energy_at(-h)) / (2 * h);
      sphere.springs->place(node, u, Vec3::Zero());
      const double force = forces[static_cast<std::size_t>(node)][axis];
      largest = std::max(largest, std::abs(force));
      worst = std::max(worst, std::abs(force + slope));
    }
  EXPECT_GT(largest, 0.01);
  EXPECT_LT(worst, 1e-6 * largest);
}

TEST(SurfaceSprings, KeepMomentumAndAngularMomentum) {
  Membrane damped = filled;
  damped.beta = 2e-3;
  Sphere sphere(damped, 2);
  sphere.stir(1e-3, 0.2);
  const Vec3 p = sphere.momentum(), l = sphere.angular_momentum();
  const double dt = 0.5 * sphere.step_limit();
  for (int n = 0; n < 500; ++n) sphere.springs->step({.dt = dt});
  double scale_p = 0;
  for (Index node = 0; node < sphere.n(); ++node) scale_p += sphere.mass(node) * 0.2;
  EXPECT_LT((sphere.momentum() - p).norm(), 1e-12 * scale_p);
  EXPECT_LT((sphere.angular_momentum() - l).norm(), 1e-12 * scale_p * radius);
}

TEST(SurfaceSprings, TurnWithoutForce) {
  Sphere sphere(empty, 2);
  const Eigen::Matrix3d r = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (Index node = 0; node < sphere.n(); ++node) {
    const Vec3& x = sphere.surface.mesh.nodes[static_cast<std::size_t>(node)];
    sphere.springs->place(node, r * x - x + Vec3(0.1, 0, 0), Vec3::Zero());
  }
  for (const Vec3& force : sphere.forces())
    EXPECT_LT(force.norm(), 1e-6) << "of 87 N/m and 1e-17 m, over 1e-9 s";
}

/// What it has and what it has lost is what it had. @return the worst that it was off, of what it had
double imbalance(const Membrane& membrane, double of_limit) {
  Sphere sphere(membrane, 2);
  sphere.stir(1e-3, 0.3);
  const Vec3 gravity(0, 0, -9.81);
  const auto sum = [&] {
    const Energies e = sphere.springs->energies(gravity);
    const Losses lost = sphere.springs->losses(), due = sphere.springs->due();
    return e.between + e.elastic + e.gravitational + lost.viscous + due.viscous + lost.numerical +
           due.numerical;
  };
  const double before = sum(), dt = of_limit * sphere.step_limit(), all = 300 * sphere.step_limit();
  double worst = 0;
  for (double t = 0; t < all; t += dt) {
    sphere.springs->step({.dt = dt, .gravity = gravity, .watch = true});
    worst = std::max(worst, std::abs(sum() - before));
  }
  return worst / before;
}

/// The trapezoid over what is not linear is of second order.
void expect_second_order(const Membrane& membrane) {
  const double coarse = imbalance(membrane, 0.3), fine = imbalance(membrane, 0.15);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(SurfaceSprings, BooksOfAnElasticOneBalance) { expect_second_order(filled); }

TEST(SurfaceSprings, BooksOfADampedOneBalance) {
  Membrane damped = filled;
  damped.beta = 1e-3;
  damped.drag = 1e-4;
  expect_second_order(damped);
}

TEST(SurfaceSprings, AnotherStepIsBooked) {
  Sphere sphere(filled, 2);
  sphere.stir(1e-4, 0.03);
  const auto sum = [&] {
    const Energies e = sphere.springs->energies(Vec3::Zero());
    const Losses lost = sphere.springs->losses();
    return e.between + e.elastic + e.gravitational + lost.numerical;
  };
  const double before = sum(), dt = 0.1 * sphere.step_limit();
  double worst = 0;
  for (int n = 0; n < 300; ++n) {
    sphere.springs->step({.dt = n % 20 < 10 ? dt : 0.5 * dt, .watch = true});
    worst = std::max(worst, std::abs(sum() - before));
  }
  EXPECT_LT(worst, 5e-3 * before);
}

/// Laplace: tension p R / 2 in all directions; in a sheet of springs with a Poisson ratio of 1/3 that is a strain of
/// p R / 2 (1 - 1/3) / (E t).
TEST(SurfaceSprings, APressureSwellsAsLaplaceSays) {
  Membrane membrane = empty;
  membrane.pressure = 50;
  membrane.beta = 5e-3;
  membrane.drag = 2e-3;
  for (const int cuts : {2, 3}) {
    Sphere sphere(membrane, cuts);
    const double dt = 0.8 * sphere.step_limit();
    for (int n = 0; n < 20000; ++n) sphere.springs->step({.dt = dt});
    double swollen = 0;
    for (Index node = 0; node < sphere.n(); ++node) swollen += sphere.position(node).norm() / sphere.n();
    const double strain = 50 * radius / 2 * (1 - 1.0 / 3) / (50e3 * 2e-3);
    EXPECT_NEAR(swollen / radius - 1, strain, 0.03 * strain) << cuts;
  }
}

TEST(SurfaceSprings, WhatItIsFilledWithResistsAsItsModulusSays) {
  Membrane membrane = empty;
  membrane.pressure = 100;
  membrane.content_modulus = 1e5;
  Sphere sphere(membrane, 2);
  EXPECT_NEAR(sphere.springs->pressure(), 100, 1e-9);
  for (Index node = 0; node < sphere.n(); ++node)
    sphere.springs->place(node, -0.01 * sphere.surface.mesh.nodes[static_cast<std::size_t>(node)],
                          Vec3::Zero());
  const double share = 1 - std::pow(0.99, 3);
  EXPECT_NEAR(sphere.springs->volume(), (1 - share) * sphere.surface.volume, 1e-12 * sphere.surface.volume);
  EXPECT_NEAR(sphere.springs->pressure(), 100 + 1e5 * share, 1e-6);
}

TEST(SurfaceSprings, NoVibrationIsFasterThanTheBoundAndItIsNear) {
  for (const Membrane& membrane : {empty, filled})
    for (const double strain : {0.0, 0.15}) {
      Sphere sphere(membrane, 1);
      sphere.stir(strain * radius, 0);
      const double found = fastest_by_differences(sphere), bound = sphere.springs->omega2();
      EXPECT_LE(found, bound * (1 + 1e-6)) << strain;
      EXPECT_GE(found, 0.45 * bound) << strain;
    }
}

TEST(SurfaceSprings, TheStableStepIsThat) {
  Membrane damped = empty;
  damped.beta = 1e-3;
  for (const Membrane& membrane : {empty, damped}) {
    Sphere sphere(membrane, 2);
    sphere.stir(1e-7, 0);
    const double before = sphere.springs->energies(Vec3::Zero()).elastic, dt = 0.95 * sphere.step_limit();
    for (int n = 0; n < 20000; ++n) sphere.springs->step({.dt = dt});
    EXPECT_LT(sphere.springs->energies(Vec3::Zero()).elastic, 20 * before);
  }
}

TEST(SurfaceSprings, GiveTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Membrane damped = filled;
    damped.beta = 1e-3;
    Sphere<float> sphere(damped, 4);
    sphere.stir(1e-3, 0.1);
    Team team(threads);
    for (int n = 0; n < 50; ++n)
      sphere.springs->step({.dt = 1e-5, .team = &team, .threads = threads, .watch = n % 7 == 0});
    const std::uint64_t hash = sphere.springs->hash(0);
    if (threads == 1) first = hash;
    EXPECT_EQ(hash, first) << threads;
  }
}

TEST(SurfaceSprings, SavedStateComesBackAtRest) {
  Sphere sphere(filled, 2);
  sphere.stir(1e-3, 0.1);
  auto saved = sphere.springs->saved();
  sphere.springs->save(saved);
  const Vec3 u = sphere.springs->displacement(5);
  for (int n = 0; n < 10; ++n) sphere.springs->step({.dt = 1e-5});
  EXPECT_NE(sphere.springs->displacement(5), u);
  sphere.springs->bring_back(saved);
  EXPECT_EQ(sphere.springs->displacement(5), u);
  EXPECT_EQ(sphere.springs->velocity(5), Vec3::Zero());
}

}  // namespace
}  // namespace palpate::physics::test
