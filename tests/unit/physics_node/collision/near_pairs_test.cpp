#include "physics_node/collision/near_pairs.h"
#include "physics_node/collision/facet_now.h"
#include "physics_node/collision/swept_contact.h"
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

/// Closer than this a pair may touch within a step in which each goes on at up to twice its speed.
double may_touch_at(const ContactBody& a, std::uint32_t mass, const ContactBody& b, const Facets::Corners& k,
                    double edge, double dt) {
  const double corner = std::max({b.speed_of(k[0]), b.speed_of(k[1]), b.speed_of(k[2])});
  return swept_distance(edge, a.candidates()) + 2 * dt * (a.speed_of(mass) + corner);
}

TEST(NearPairs, GiveAFastMassAWideReachAndNoOther) {
  constexpr double dt = 1e-3;
  Heap heap(1, 0.012);
  const auto fly = [&](std::size_t every) {
    for (auto& body : heap.moving) {
      const auto& masses = body->body().lattice.masses;
      for (std::size_t n = 0; n < masses.size(); n += every)
        body->place(masses[n], body->displacement(masses[n]), Vec3(8, 0, 0));  // 8 mm in a step
    }
    for (auto& body : heap.bodies) body.refresh(0);
    NearPairs near(heap.bodies, PairKind::facets);
    near.allow(0, 1, true);
    near.update(heap.bodies, dt);
    std::set<Key> listed;
    for (const NearPair& pair : near.links()[1].facets.pairs()) listed.insert(key(pair));
    EXPECT_EQ(near.overflows(), 0);
    for (std::uint32_t b = 0; b < 2; ++b) {
      const ContactBody &other = heap.bodies[b], &body = heap.bodies[1 - b];
      for (std::uint32_t f = 0; f < other.facets()->all().size(); ++f) {
        const auto& k = other.facets()->all()[f];
        if (k[0] == k[1]) continue;
        const auto [t, edge] = facet_now(other.candidates(), k);
        for (std::uint32_t i = 0; i < body.candidates().size(); ++i)
          if (closest_point(body.candidates().x()[i], t).distance <
              may_touch_at(body, i, other, k, edge, dt)) {
            EXPECT_TRUE(listed.count({1 - b, i, b, f})) << "mass " << i << " facet " << f;
          }
      }
    }
    return listed.size();
  };
  const std::size_t rest = fly(1000000), few = fly(29), all = fly(1);
  EXPECT_GT(few, rest);
  EXPECT_LT(few, rest + (all - rest) / 3);
}

/// Three balls in a row, a large one that flies, one of a few masses, and a large one.
struct Row {
  std::vector<std::unique_ptr<BodyModel>> moving;
  std::vector<ContactBody> bodies;

  Row(double speed, const std::array<double, 3>& at) {
    for (std::size_t b = 0; b < 3; ++b) {
      moving.push_back(make_body_model(
          test::body_of({.shape = Recipe::sphere(b == 1 ? 5 : 20), .spacing_mm = 5}), Precision::double_));
      const Lattice& lattice = moving[b]->body().lattice;
      Vec3 middle = Vec3::Zero();
      for (const Index cell : lattice.masses) middle += lattice.rest_position(cell);
      middle /= static_cast<double>(lattice.masses.size());
      for (const Index cell : lattice.masses)
        moving[b]->place(cell, Vec3(at[b], 0, 0) - middle, Vec3(b == 0 ? speed : 0, 0, 0));
    }
    bodies.reserve(3);
    for (auto& body : moving) bodies.emplace_back(*body, true, false);
    for (auto& body : bodies) body.refresh(0);
  }
};

// What the first hits would be through the third by the end of the step, which no list of the beginning
// holds.
TEST(NearPairs, AreMadeAnewWithinAStepForWhatIsHit) {
  constexpr double dt = 1e-3;
  Row row(20, {0, 0.0275, 0.0645});
  NearPairs near(row.bodies, PairKind::facets);
  for (std::uint32_t a = 0; a < 3; ++a)
    for (std::uint32_t b = a + 1; b < 3; ++b) near.allow(a, b, true);
  near.update(row.bodies, dt);
  const auto second_with_third = [&] {
    for (const Link& link : near.links())
      if (link.a == 1 && link.b == 2) return link.facets.pairs().size();
    return std::size_t{0};
  };
  ASSERT_EQ(second_with_third(), 0);
  SweptContact contact(row.bodies, near.most_facets());
  ContactImpulses impulses(row.bodies);
  impulses.begin_step();
  const SweptReport report = contact.step(row.bodies, near, 1, dt, impulses);
  EXPECT_EQ(report.overflows, 0);
  EXPECT_GT(second_with_third(), 0);
  const Candidates& c = row.bodies[1].candidates();
  double fastest = 0;
  for (std::uint32_t i = 0; i < c.size(); ++i) {
    const Vec3 by = dt * impulses.v_move(row.bodies, {1, i});
    fastest = std::max(fastest, by.norm());
    for (std::uint32_t f = 0; f < row.bodies[2].facets()->all().size(); ++f) {
      const auto& k = row.bodies[2].facets()->all()[f];
      const Triangle t = facet_now(row.bodies[2].candidates(), k).corner;
      const Triangle dt_by{dt * impulses.v_move(row.bodies, {2, k[0]}),
                           dt * impulses.v_move(row.bodies, {2, k[1]}),
                           dt * impulses.v_move(row.bodies, {2, k[2]})};
      EXPECT_FALSE(passes_through(c.x()[i], by, t, dt_by)) << "mass " << i << " facet " << f;
    }
  }
  EXPECT_GT(fastest, 0.012) << "as far as the third is away";
}

}  // namespace
}  // namespace palpate::physics
