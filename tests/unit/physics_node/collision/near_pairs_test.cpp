#include "physics_node/collision/near_pairs.h"
#include "physics_node/collision/facet_now.h"
#include "physics_node/step/body_model.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;
using test::Recipe;
using Key = std::array<std::uint32_t, 4>;

Key key(const NearPair& p) { return {p.mass.body, p.mass.n, p.other.body, p.other.n}; }

/// Two lumps of masses thrown about, so that many of them are near each other.
struct Heap {
  std::vector<std::unique_ptr<BodyModel>> moving;
  std::vector<ContactBody> bodies;

  Heap(std::uint64_t seed, double spread) {
    for (const double spacing : {10.0, 6.0}) {
      Recipe recipe{.shape = Recipe::sphere(20), .spacing_mm = spacing};
      moving.push_back(make_body_model(test::body_of(recipe), Precision::double_));
    }
    Dice dice(seed);
    for (auto& body : moving)
      for (const Index cell : body->body().lattice.masses)
        body->place(cell, dice.within(spread), Vec3::Zero());
    bodies.reserve(2);
    for (auto& body : moving) bodies.emplace_back(*body, true, false);
    for (auto& body : bodies) body.refresh(0);
  }
};

TEST(NearPairs, HoldEveryPairOfMassesWithinReach) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Heap heap(seed, 0.02);
    NearPairs near(heap.bodies, PairKind::masses);
    for (std::uint32_t a = 0; a < 2; ++a)
      for (std::uint32_t b = a; b < 2; ++b) near.allow(a, b, true);
    near.update(heap.bodies, 0);
    std::set<Key> listed;
    for (const Link& link : near.links())
      for (const NearPair& pair : link.masses.pairs())
        EXPECT_TRUE(listed.insert(key(pair)).second) << "seed " << seed;
    std::size_t expected = 0;
    for (std::uint32_t a = 0; a < 2; ++a)
      for (std::uint32_t b = a; b < 2; ++b) {
        const Candidates& c = heap.bodies[a].candidates();
        const Candidates& d = heap.bodies[b].candidates();
        for (std::uint32_t i = 0; i < c.size(); ++i)
          for (std::uint32_t j = a == b ? i + 1 : 0; j < d.size(); ++j) {
            if ((c.x()[i] - d.x()[j]).norm() >= paper_distance(c, d) || (a == b && c.are_joined(i, j)))
              continue;
            ++expected;
            EXPECT_TRUE(listed.count({a, i, b, j})) << "seed " << seed;
          }
      }
    EXPECT_GT(expected, 20U) << "seed " << seed;
    EXPECT_EQ(near.overflows(), 0);
  }
}

TEST(NearPairs, HoldEveryMassWithinReachOfAFacet) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Heap heap(seed, 0.012);
    NearPairs near(heap.bodies, PairKind::facets);
    for (std::uint32_t a = 0; a < 2; ++a)
      for (std::uint32_t b = a; b < 2; ++b) near.allow(a, b, true);
    near.update(heap.bodies, 0);
    std::set<Key> listed;
    for (const Link& link : near.links())
      for (const NearPair& pair : link.facets.pairs())
        EXPECT_TRUE(listed.insert(key(pair)).second) << "seed " << seed;
    std::size_t expected = 0;
    for (std::uint32_t b = 0; b < 2; ++b) {
      const Candidates& d = heap.bodies[b].candidates();
      for (std::uint32_t f = 0; f < heap.bodies[b].facets()->all().size(); ++f) {
        const auto& k = heap.bodies[b].facets()->all()[f];
        if (k[0] == k[1]) continue;  // a loose mass, which only loose ones seek
        const auto [t, edge] = facet_now(d, k);
        for (std::uint32_t a = 0; a < 2; ++a) {
          const Candidates& c = heap.bodies[a].candidates();
          for (std::uint32_t i = 0; i < c.size(); ++i) {
            if (closest_point(c.x()[i], t).distance >= swept_distance(edge, c)) continue;
            const bool own = a == b && (i == k[0] || i == k[1] || i == k[2] || c.are_joined(i, k[0]) ||
                                        c.are_joined(i, k[1]) || c.are_joined(i, k[2]));
            if (own) continue;
            ++expected;
            EXPECT_TRUE(listed.count({a, i, b, f}))
                << "seed " << seed << " body " << a << " mass " << i << " at " << c.x()[i].transpose()
                << " of facet " << f << " of body " << b << " " << k[0] << " " << k[1] << " " << k[2]
                << " edge " << edge;
          }
        }
      }
    }
    EXPECT_GT(expected, 100U) << "seed " << seed;
  }
}

TEST(NearPairs, AreMadeAnewOnlyWhenSomethingHasMovedByHalfTheSkin) {
  Heap heap(1, 0.0);
  NearPairs near(heap.bodies, PairKind::masses);
  near.allow(0, 1, true);
  near.update(heap.bodies, 0);
  const auto shift = [&](double by) {
    for (const Index cell : heap.moving[1]->body().lattice.masses)
      heap.moving[1]->place(cell, Vec3(by, 0, 0), Vec3::Zero());
    for (auto& body : heap.bodies) body.refresh(0);
    near.update(heap.bodies, 0);
  };
  const double skin = 0.4 * 0.5 * (6e-3 + 10e-3);
  shift(0.9 * skin);
  EXPECT_EQ(near.rebuilds(), 1);
  shift(1.1 * skin);
  EXPECT_EQ(near.rebuilds(), 2);
}

// All corners of a stretched facet may be far outside the box of what it reaches over.
TEST(NearPairs, HoldASmallBodyUnderAWidelyStretchedFacet) {
  std::vector<std::unique_ptr<BodyModel>> moving;
  for (const double radius : {50.0, 6.0})
    moving.push_back(make_body_model(
        test::body_of({.shape = Recipe::sphere(radius), .spacing_mm = radius / 5}), Precision::double_));
  const Lattice& lattice = moving[0]->body().lattice;
  std::vector<ContactBody> bodies;
  bodies.reserve(2);
  for (auto& body : moving) bodies.emplace_back(*body, true, false);
  // The first facet of the large one is drawn out round the small one, which stands at the origin.
  const auto corners = bodies[0].facets()->all()[0];
  for (const Index cell : lattice.masses)
    moving[0]->place(cell, Vec3(1, 0, 0) - 0.9 * lattice.rest_position(cell), Vec3::Zero());
  const std::array<Vec3, 3> far{Vec3(-0.2, -0.2, 0.0075), Vec3(0.3, 0, 0.0075), Vec3(-0.2, 0.2, 0.0075)};
  for (std::size_t i = 0; i < 3; ++i) {
    const Index cell = bodies[0].candidates().cell()[corners[i]];
    moving[0]->place(cell, far[i] - lattice.rest_position(cell), Vec3::Zero());
  }
  for (auto& body : bodies) body.refresh(0);
  NearPairs near(bodies, PairKind::facets);
  near.allow(0, 1, true);
  near.update(bodies, 0);
  std::size_t listed = 0;
  for (const Link& link : near.links())
    for (const NearPair& pair : link.facets.pairs())
      listed += pair.other.body == 0 && pair.other.n == 0 ? 1 : 0;
  EXPECT_GT(listed, 0U);
}

TEST(NearPairs, OfABodyAtRestAreNone) {
  std::vector<ContactBody> bodies;
  const auto moving = make_body_model(test::body_of({.shape = Recipe::sphere(50)}), Precision::double_);
  bodies.emplace_back(*moving, true, false);
  bodies[0].refresh(0);
  NearPairs near(bodies, PairKind::both);
  near.allow(0, 0, true);
  near.update(bodies, 0);
  EXPECT_EQ(near.size(), 0);
}

}  // namespace
}  // namespace palpate::physics
