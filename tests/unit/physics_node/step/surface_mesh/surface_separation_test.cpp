// A surface of springs that comes apart along its edges: nothing is lost, springs are shared, no step becomes too long.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "physics_node/mesh/simplex_net.h"
#include "physics_node/step/surface_mesh/surface_spectrum.h"
#include "tests/support/physics/sphere_of_springs.h"

namespace palpate::physics::test {
namespace {

constexpr std::size_t room = 4000;  // for copies

std::vector<std::pair<Index, Index>> edges_at_random(const TriangleNet& net, unsigned seed) {
  std::vector<std::pair<Index, Index>> all;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t side = 0; side < 3; ++side)
      if (net.beyond(t, side) > t) all.emplace_back(t, net.beyond(t, side));
  std::ranges::shuffle(all, std::mt19937(seed));
  return all;
}

/// With room for copies, and what a body does when a tool cuts it.
struct PartedSphere {
  PartedSphere(const Membrane& membrane, int cuts)
      : surface(spring_surface(palpate::test::made_sphere(radius, cuts), membrane)),
        net(surface.mesh.triangles, surface.mesh.nodes.size(), room),
        springs(surface, with_room()) {}
  std::vector<double> with_room() const {
    std::vector<double> inverse;
    for (const double mass : surface.mass) inverse.push_back(1 / mass);
    inverse.resize(inverse.size() + room, 0.0);
    return inverse;
  }
  void open(std::span<const std::pair<Index, Index>> edges) {
    net.begin();
    for (const auto& [a, b] : edges) net.open(a, b);
    grown += springs.separate(net.splits(), net);
  }
  Vec3 rest(Index node) const { return surface.mesh.nodes[static_cast<std::size_t>(net.origin(node))]; }
  Vec3 position(Index node) const { return rest(node) + springs.displacement(node); }
  struct Sums {
    double mass = 0, energy = 0;
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero(), middle = Vec3::Zero();
  };
  Sums sums() {
    Sums all;
    for (Index node = 0; node < net.n_nodes(); ++node) {
      const double m = springs.mass(node, net);
      all.mass += m, all.momentum += m * springs.velocity(node), all.middle += m * position(node);
      all.angular += position(node).cross(m * springs.velocity(node));
    }
    const Energies e = springs.energies(Vec3::Zero());
    all.energy = e.kinetic + e.elastic + e.gravitational;
    return all;
  }
  void stir(double displacement, double velocity) {
    Dice dice(3);
    for (Index node = 0; node < net.n_nodes(); ++node)
      springs.place(node, dice.within(displacement), dice.within(velocity));
  }

  SpringSurface surface;
  TriangleNet net;
  SurfaceSprings<double> springs;
  double grown = 0;
};

TEST(SurfaceSeparation, LosesNothing) {
  for (const Membrane& membrane : {empty, filled}) {
    PartedSphere sphere(membrane, 3);
    sphere.stir(2e-3, 0.3);
    const PartedSphere::Sums before = sphere.sums();
    const auto edges = edges_at_random(sphere.net, 7);
    for (std::size_t n = 0; n < edges.size(); n += 40) {
      sphere.open(std::span(edges).subspan(n, std::min<std::size_t>(40, edges.size() - n)));
      const PartedSphere::Sums now = sphere.sums();
      ASSERT_NEAR(now.mass, before.mass, 1e-14 * before.mass);
      ASSERT_LT((now.momentum - before.momentum).norm(), 1e-13 * before.mass);
      ASSERT_LT((now.angular - before.angular).norm(), 1e-13 * before.mass * radius);
      ASSERT_LT((now.middle - before.middle).norm(), 1e-14 * before.mass * radius);
      ASSERT_NEAR(now.energy, before.energy + sphere.grown, 1e-12 * before.energy);
    }
    EXPECT_EQ(sphere.net.n_nodes(), 3 * sphere.net.n_elements()) << "every triangle for itself";
  }
}

/// What it was filled with has gone, and that is booked.
TEST(SurfaceSeparation, LeaksWhereItOpens) {
  PartedSphere sphere(filled, 2);
  for (Index node = 0; node < sphere.net.n_nodes(); ++node)
    sphere.springs.place(node, -0.01 * sphere.rest(node), Vec3::Zero());
  ASSERT_GT(sphere.springs.pressure(), filled.pressure);
  const auto edges = edges_at_random(sphere.net, 1);
  sphere.open(std::span(edges).first(1));
  EXPECT_EQ(sphere.net.n_copies(), 0);
  EXPECT_GT(sphere.springs.pressure(), filled.pressure) << "one edge alone opens nothing";
  // A second edge at one of its nodes parts that.
  const Index node = sphere.net.face(edges[0].first, 0)[0];
  sphere.net.each_corner(node, [&](Index t, std::size_t) {
    for (std::size_t side = 0; side < 3; ++side)
      if (sphere.net.n_copies() == 0) sphere.open(std::vector{std::pair{t, sphere.net.beyond(t, side)}});
  });
  ASSERT_GT(sphere.net.n_copies(), 0);
  EXPECT_EQ(sphere.springs.pressure(), 0);
  EXPECT_LT(sphere.grown, 0);
}

/// The forces on copies are those on the node that they were, shared.
TEST(SurfaceSeparation, SharesForces) {
  PartedSphere whole(empty, 2), parted(empty, 2);
  whole.stir(2e-3, 0), parted.stir(2e-3, 0);
  const auto edges = edges_at_random(parted.net, 4);
  parted.open(std::span(edges).first(edges.size() / 2));
  ASSERT_GT(parted.net.n_copies(), 50);
  const double dt = 1e-7;
  whole.springs.step({.dt = dt}), parted.springs.step({.dt = dt});
  std::vector<Vec3> pushed(static_cast<std::size_t>(parted.net.n_loaded()), Vec3::Zero());
  for (Index node = 0; node < parted.net.n_nodes(); ++node)
    pushed[static_cast<std::size_t>(parted.net.origin(node))] +=
        parted.springs.mass(node, parted.net) * parted.springs.velocity(node);
  for (Index node = 0; node < whole.net.n_nodes(); ++node) {
    const Vec3 all = whole.springs.mass(node, whole.net) * whole.springs.velocity(node);
    EXPECT_LT((pushed[static_cast<std::size_t>(node)] - all).norm(), 1e-9 * (all.norm() + 1e-12));
  }
}

/// Of what hangs together still, by how fast a step as long as loose triangles allow makes it grow.
TEST(SurfaceSeparation, NeverVibratesFasterThanItsLooseTriangles) {
  Membrane damped = empty;
  damped.beta = 1e-3, damped.drag = 1e-4;
  for (const Membrane& membrane : {empty, damped}) {
    PartedSphere sphere(membrane, 2);
    const double dt =
        0.98 * stable_step(stiffest_mode_of_loose_triangles(sphere.surface), Integrator::symplectic_euler);
    const auto edges = edges_at_random(sphere.net, 5);
    sphere.stir(1e-7, 0);
    const double before = sphere.springs.energies(Vec3::Zero()).elastic;
    const std::size_t at_once = edges.size() / 8;
    for (std::size_t n = 0; n < edges.size(); n += at_once) {
      sphere.open(std::span(edges).subspan(n, std::min(at_once, edges.size() - n)));
      for (int k = 0; k < 2000; ++k) sphere.springs.step({.dt = dt});
      EXPECT_LT(sphere.springs.energies(Vec3::Zero()).elastic, 20 * before) << n;
    }
  }
}

TEST(SurfaceSeparation, IsWholeAgainAfterAReset) {
  const auto run = [](PartedSphere& sphere) {
    sphere.stir(2e-3, 0.3);
    for (int k = 0; k < 50; ++k) sphere.springs.step({.dt = 1e-5});
    return sphere.springs.hash(0);
  };
  PartedSphere sphere(filled, 3);
  const std::uint64_t first = run(sphere);
  const auto edges = edges_at_random(sphere.net, 2);
  sphere.open(std::span(edges).first(300));
  const std::uint64_t parted = run(sphere);
  EXPECT_NE(parted, first);
  sphere.springs.forget(), sphere.net.reset(), sphere.springs.rejoin();
  EXPECT_EQ(run(sphere), first);
  sphere.springs.forget();
  sphere.open(std::span(edges).first(300));
  EXPECT_EQ(run(sphere), parted);
}

}  // namespace
}  // namespace palpate::physics::test
