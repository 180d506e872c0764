// Nothing tunnels: spheres shot at plates, tubes and spheres at 0.1 to 10 m/s stay outside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/scene/load_scene.h"
#include "physics_node/collision/point_triangle.h"
#include "physics_node/lattice/triangles.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

struct Shot {
  double speed = 0;  // [m/s]
  std::string text;  // of the scene
};

std::string target(int kind, double spacing_mm, Dice& dice) {
  if (kind == 0)
    return fmt::format("shape = \"box\"\nsize_mm = [100, 100, {}]\nfixed = [\"-x\", \"+x\"]", spacing_mm * dice.between(0.8, 2));
  if (kind == 1)
    return fmt::format(
        "shape = \"tube\"\nouter_radius_mm = 40\ninner_radius_mm = {}\nlength_mm = 100\naxis = \"x\"\nfixed = [\"-x\", \"+x\"]",
        40 - 1.5 * spacing_mm);
  return "shape = \"sphere\"\nradius_mm = 40";
}

/// A small hard sphere on its way to a target that bends but does not break.
Shot random_shot(Dice& dice, const char* distance) {
  Shot shot;
  shot.speed = std::pow(10.0, dice.between(-1, 1));
  const int kind = static_cast<int>(dice.between(0, 3));
  const double L = dice.between(5, 10), l = L * dice.between(0.4, 1.5), radius = l * dice.between(1.2, 3);
  const double start = (kind == 0 ? 2 * L : 40) + radius + dice.between(12, 17);
  const Vec3 way = Vec3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), -1);
  const Vec3 from = -start * way + Vec3(dice.between(-10, 10), dice.between(-10, 10), 0);
  const Vec3 v = shot.speed * way.normalized();
  shot.text = fmt::format(
      "gravity_m_per_s2 = [0, 0, 0]\n[contact]\ndistance = \"{}\"\ncount_passages = true\n"
      "[[body]]\nname = \"target\"\nspacing_mm = {}\nmaterial = \"soft\"\n{}\n"
      "[[body]]\nname = \"bullet\"\nspacing_mm = {}\nmaterial = \"hard\"\nshape = \"sphere\"\nradius_mm = {}\n"
      "at_mm = [{}, {}, {}]\nvelocity_m_per_s = [{}, {}, {}]\n"
      "[material.soft]\nmass_g = 1\nk1_N_per_m = {}\nviscosity_N_s_per_m = 0.05\n"
      "[material.hard]\nmass_g = {}\nk1_N_per_m = {}\nviscosity_N_s_per_m = 0.05\n",
      distance, L, target(kind, L, dice), l, radius, from.x(), from.y(), from.z(), v.x(), v.y(), v.z(),
      std::pow(10.0, dice.between(1.5, 4)), std::pow(10.0, dice.between(-1, 1)), std::pow(10.0, dice.between(2, 4)));
  return shot;
}

void run(World& world, double speed) {
  const double seconds = std::min(0.6, 0.15 / speed) + 0.02;
  while (world.t() < seconds && !world.has_stopped()) world.frame({});
}

/// Masses of `inner` that are inside the closed surface of `outer`: a ray from such a mass meets it an odd number of times.
int count_inside(const MovingBody& inner, const MovingBody& outer, Dice& dice) {
  const Lattice& lattice = outer.body().lattice;
  const auto mask = [&](Index cell) { return outer.mask(cell); };
  const auto patterns = triangle_patterns(lattice);
  std::vector<Triangle> triangles;
  for (const Index cell : lattice.masses)
    for (const TrianglePattern& t : patterns[static_cast<std::size_t>(lattice.row_kind(cell))])
      if (holds(t.edges[0], cell, mask) && is_boundary(t, cell, mask))
        triangles.push_back({outer.position(cell), outer.position(cell + t.corner[0]), outer.position(cell + t.corner[1])});
  int inside = 0;
  for (const Index cell : inner.body().lattice.masses) {
    int odd = 0;
    for (int ray = 0; ray < 3; ++ray) {  // a ray may graze an edge: two of three decide
      const Vec3 far = 100 * dice.within(1).normalized();
      int hits = 0;
      for (const Triangle& t : triangles)
        hits += passes_through(inner.position(cell), far, t, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}) ? 1 : 0;
      odd += hits % 2;
    }
    inside += odd >= 2 ? 1 : 0;
  }
  return inside;
}

TEST(Tunnelling, NoMassGoesThroughAFacetInSweptContact) {
  const std::uint64_t seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  std::int64_t collisions = 0;
  for (int n = 0; n < 60; ++n) {
    const Shot shot = random_shot(dice, "swept");
    World world(parse_scene(shot.text, "shot.toml"));
    run(world, shot.speed);
    const CollisionTally& tally = world.collisions()->tally();
    EXPECT_EQ(tally.passages, 0) << "shot " << n << " at " << shot.speed << " m/s";
    EXPECT_EQ(tally.overflows, 0) << "shot " << n;
    EXPECT_EQ(world.report().restored, 0) << "shot " << n;
    EXPECT_EQ(count_inside(world.body(1), world.body(0), dice), 0) << "shot " << n << " at " << shot.speed << " m/s";
    collisions += tally.collisions;
  }
  EXPECT_GT(collisions, 1000);
}

TEST(Tunnelling, PassagesInPaperContactAreCounted) {
  Dice dice(1);
  std::int64_t passages = 0;
  for (int n = 0; n < 10; ++n) {
    const Shot shot = random_shot(dice, "paper");
    World world(parse_scene(shot.text, "shot.toml"));
    run(world, shot.speed);
    passages += world.collisions()->tally().passages;
  }
  EXPECT_GT(passages, 0) << "mass against mass lets some through";
}

}  // namespace
}  // namespace palpate::physics::test
