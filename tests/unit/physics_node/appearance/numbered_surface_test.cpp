// What makes one surface of another: everything that differs, nothing else, and no number that changes its meaning.
#include "physics_node/appearance/numbered_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;

using Named = std::array<double, 5>;  // a facet by where its corners rest and its colour

double name_of(Index cell, const Vec3& rest) { return cell >= 0 ? static_cast<double>(cell) : -1 - rest.x(); }

std::multiset<Named> named(const NumberedSurface& surface, const std::vector<double>& names) {
  std::multiset<Named> all;
  for (std::size_t f = 0; f < surface.facets().size(); ++f) {
    const auto& c = surface.facets()[f];
    all.insert({names.at(c[0]), names.at(c[1]), names.at(c[2]), names.at(c[3]),
                static_cast<double>(surface.rgba()[f])});
  }
  return all;
}

std::multiset<Named> named(const Surface& surface) {
  std::vector<double> names;
  for (std::size_t v = 0; v < surface.n_vertices(); ++v)
    names.push_back(name_of(v < surface.n_moving() ? surface.cell[v] : -1, surface.rest[v]));
  return named(NumberedSurface(surface), names);
}

/// Of nodes drawn from a few, so that much comes again: masses 0 to 19, scenery at x = 0 to 9.
Surface random_surface(Dice& dice, int n_facets) {
  Surface surface;
  std::set<int> masses, scenery;
  for (int n = 0; n < 15; ++n) masses.insert(static_cast<int>(dice.between(0, 20)));
  for (int n = 0; n < 6; ++n) scenery.insert(static_cast<int>(dice.between(0, 10)));
  for (const int mass : masses) {
    surface.cell.push_back(mass);
    surface.rest.emplace_back(mass, 1, 0);
  }
  for (const int place : scenery) surface.rest.emplace_back(place, 0, 0);
  const auto any = [&] {
    return static_cast<std::uint32_t>(dice.between(0, static_cast<double>(surface.n_vertices()) - 0.001));
  };
  // From few corners and colours: the same facet also stands there twice.
  for (int n = 0; n < n_facets; ++n) {
    const std::uint32_t a = any() % 6, b = any();
    surface.facets.push_back({a, b, b, b});
    surface.rgba.push_back(static_cast<std::uint32_t>(dice.between(0, 2)));
  }
  surface.hidden = static_cast<std::uint64_t>(dice.between(0, 100));
  return surface;
}

TEST(NumberedSurface, BecomesAnySurfaceByWhatDiffersAndNothingElse) {
  Dice dice(4);
  for (int run = 0; run < 50; ++run) {
    const Surface first = random_surface(dice, 40);
    NumberedSurface shown(first);
    std::vector<double> names;
    for (std::size_t v = 0; v < first.n_vertices(); ++v)
      names.push_back(name_of(shown.cell(v), first.rest[v]));
    for (int round = 0; round < 10; ++round) {
      const Surface next = random_surface(dice, static_cast<int>(dice.between(0, 80)));
      const auto before = named(shown, names), after = named(next);
      const SurfaceDelta delta = shown.delta_to(next);
      for (const auto& vertex : delta.vertices) {
        names.push_back(name_of(vertex.cell, vertex.rest));
        EXPECT_EQ(std::count(names.begin(), names.end(), names.back()), 1) << "it was there already";
      }
      shown.apply(delta);
      ASSERT_EQ(named(shown, names), after) << run << " " << round;
      EXPECT_EQ(shown.hidden(), next.hidden);
      std::vector<Named> gone, added;
      std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(gone));
      std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                          std::back_inserter(added));
      EXPECT_LE(delta.facets.size(), std::max(gone.size(), added.size()));
      EXPECT_TRUE(shown.delta_to(next).facets.empty());
    }
  }
}

TEST(NumberedSurface, MovesItsLastFacetsIntoThePlacesOfThoseThatAreGone) {
  Surface surface;
  for (int mass = 0; mass < 6; ++mass) {
    surface.cell.push_back(mass);
    surface.rest.emplace_back(mass, 0, 0);
    const auto n = static_cast<std::uint32_t>(mass);
    surface.facets.push_back({n, n, n, n});
    surface.rgba.push_back(0);
  }
  NumberedSurface shown(surface);
  for (const int gone : {5, 3, 0}) {
    surface.facets.erase(surface.facets.begin() + gone);
    surface.rgba.pop_back();
  }
  const SurfaceDelta delta = shown.delta_to(surface);
  ASSERT_EQ(delta.facets.size(), 1u);
  EXPECT_EQ(delta.facets[0].facet, 0u);
  EXPECT_EQ(delta.facets[0].corners[0], 4u);
  EXPECT_EQ(delta.total_facets, 3u);
}

TEST(NumberedSurface, KnowsWhichVerticesMayMove) {
  Surface surface;
  for (int n = 0; n < 3; ++n) surface.rest.emplace_back(n, 0, 0);
  EXPECT_TRUE(NumberedSurface(surface).is_rigid());
  surface.cell.push_back(7);
  NumberedSurface shown(surface);
  EXPECT_FALSE(shown.is_rigid());
  EXPECT_TRUE(shown.may_move(0, 2));
  EXPECT_FALSE(shown.may_move(1, 3));
  surface.cell.push_back(8);
  surface.rest.insert(surface.rest.begin() + 1, Vec3(9, 9, 9));
  shown.apply(shown.delta_to(surface));
  ASSERT_EQ(shown.n_vertices(), 4u);
  EXPECT_FALSE(shown.may_move(1, 3));
  EXPECT_TRUE(shown.may_move(3, 4));
  EXPECT_EQ(shown.cell(3), 8);
}

}  // namespace
}  // namespace palpate::physics
