#pragma once
// What every body of finite elements keeps to that a scalpel parts, whatever its elements are: a block round the origin, cut along -x
// by an edge along z that begins 5 mm beside it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/physics/led_blade.h"

namespace palpate::physics::test {

inline int n_copies(const Body& body) {
  int n = 0;
  body.each_copy([&](Index) { ++n; });
  return n;
}

inline double mass_of(const Body& body) {
  double sum = 0;
  body.each_node([&](Index node) { sum += node_mass(body, node); });
  return sum;
}

/// @param size  of the block [m] @param path  of the tip: its y and z
struct BladeChecks {
  Vec3 size;
  Vec3 path;
  Vec3 at(double x) const { return {x, path.y(), path.z()}; }
  Vec3 begin() const { return at(0.020); }

  /// @param recipe  of a body that nothing holds, without viscosity
  void expect_nothing_lost(const Recipe& recipe) const {
    LedBlade cut(recipe, begin());
    const Body& body = cut.world.body(0).body();
    const double before = mass_of(body);
    EXPECT_NEAR(before, 1000 * size.prod(), 1e-9 * before);
    cut.along(at(-0.010), 3);
    EXPECT_GT(n_copies(body), 10);
    EXPECT_NEAR(mass_of(body), before, 1e-14 * before);
    const MomentumBalance balance = cut.world.body(0).momentum_balance();
    EXPECT_LT(balance.missing.linear.norm(), 1e-11 * balance.linear);
    EXPECT_LT(balance.missing.angular.norm(), 1e-11 * balance.angular);
    EXPECT_LT(cut.world.ledger().balance_error(), 1e-3);
  }

  void expect_nothing_felt_in_its_slot(const Recipe& recipe) const {
    LedBlade cut(recipe, begin());
    cut.along(at(0), 0.2);
    const double opened = cut.book().cut_area();
    EXPECT_GT(opened, 0.3 * size.x() * size.z());
    for (const Vec3& force : cut.along(begin(), 0.2)) EXPECT_GT(force.x(), -0.02);
    for (const Vec3& force : cut.along(at(0.008), 0.2)) EXPECT_LT(force.norm(), 0.1);
    EXPECT_NEAR(cut.book().cut_area(), opened, 0.02 * size.x() * size.z());
  }

  /// On any number of threads, and again after a reset.
  void expect_the_same_again(const Recipe& recipe) const {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3}) {
      Recipe with_threads = recipe;
      with_threads.physics += fmt::format("\nthreads = {}", threads);
      LedBlade cut(with_threads, begin());
      const Body& body = cut.world.body(0).body();
      const std::uint64_t whole = cut.world.state_hash();
      cut.along(at(0.005), 0.2);
      EXPECT_GT(n_copies(body), 0);
      hashes.push_back(cut.world.state_hash());
      if (threads > 1) continue;
      cut.world.reset();
      EXPECT_EQ(n_copies(body), 0);
      EXPECT_EQ(cut.world.state_hash(), whole);
      EXPECT_EQ(cut.world.fragments(0)->count(), 1);
      cut.path.assign(2, begin());
      cut.along(at(0.005), 0.2);
      EXPECT_EQ(cut.world.state_hash(), hashes[0]) << "as if nothing had been";
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
  }
};

}  // namespace palpate::physics::test
