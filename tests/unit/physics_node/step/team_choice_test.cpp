// How many threads: decisions on machines that are made up, where a step takes what a function says. No clock.

#include "physics_node/step/team_choice.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace palpate::physics {
namespace {

using Machine = std::function<double(int threads, double t)>;  // what a step takes [s], at a time of stepping

/// Runs for so long; @return time of stepping
double run(TeamChoice& choice, const Machine& machine, double seconds, double from = 0) {
  double t = from;
  while (t < from + seconds) {
    const double step = machine(choice.threads(), t);
    choice.took(static_cast<std::int64_t>(1e9 * step));
    t += step;
  }
  return t - from;
}

/// A step of 0.75 ms on one thread; `share` of that on two.
Machine of_share(double share) {
  return [share](int threads, double) { return threads > 1 ? share * 0.75e-3 : 0.75e-3; };
}

/// Time of the same number of steps over time of the best fixed choice.
double loss(const Machine& machine, double seconds, double best_step) {
  TeamChoice choice = TeamChoice::up_to(2);
  int steps = 0;
  const double t = run(
      choice, [&](int threads, double now) { return ++steps, machine(threads, now); }, seconds);
  return t / (steps * best_step) - 1;
}

TEST(TeamChoice, TakesATeamThatPays) {
  TeamChoice choice = TeamChoice::up_to(2);
  EXPECT_EQ(choice.threads(), 1) << "first of all one";
  run(choice, of_share(0.55), 1);
  EXPECT_EQ(choice.changes(), 1);
  run(choice, of_share(0.55), 60);
  EXPECT_EQ(choice.changes(), 1) << "and stays with it";
  EXPECT_GT(choice.mean_threads(), 1.98);
  EXPECT_LE(choice.trials(), 14) << "at growing intervals: 0.25 s to 4 s are five, then one in 8 s";
}

TEST(TeamChoice, LeavesATeamThatDoesNotPay) {
  for (const double share : {0.95, 1.0, 1.5, 40.0}) {
    TeamChoice choice = TeamChoice::up_to(2);
    run(choice, of_share(share), 60);
    EXPECT_EQ(choice.changes(), 0) << share;
    EXPECT_GE(choice.trials(), 10) << share << ": it looks again";
    EXPECT_LT(choice.mean_threads(), 1.01) << share;
  }
}

TEST(TeamChoice, CostsWhatItsHeaderSays) {
  EXPECT_LT(loss(of_share(1.9), 8, 0.75e-3), 0.025);
  EXPECT_LT(loss(of_share(1.9), 80, 0.75e-3), 0.008);
  EXPECT_LT(loss(of_share(0.55), 8, 0.55 * 0.75e-3), 0.02);
  // A step of such a team takes 37 ms. One of them is enough.
  EXPECT_LT(loss(of_share(50), 80, 0.75e-3), 0.01);
}

TEST(TeamChoice, FollowsTheMachine) {
  const auto crowded_for_a_while = [](int threads, double t) {
    const bool crowded = t > 20 && t < 60;
    return 0.75e-3 * (threads == 1 ? (crowded ? 1.6 : 1) : (crowded ? 30 : 0.55));
  };
  TeamChoice choice = TeamChoice::up_to(2);
  run(choice, crowded_for_a_while, 20);
  EXPECT_EQ(choice.threads(), 2);
  run(choice, crowded_for_a_while, 1, 20);
  EXPECT_EQ(choice.threads(), 1) << "within a second of stepping, not at the next interval of 8 s";
  run(choice, crowded_for_a_while, 39, 21);
  EXPECT_LE(choice.changes(), 2);
  run(choice, crowded_for_a_while, 10, 60);
  EXPECT_EQ(choice.threads(), 2) << "and back";
}

/// A core that others use stops a step now and then for a slice of 3 ms: a team at 0.7 is found for all that, and at the
/// margin it does not go to and fro.
TEST(TeamChoice, IsNotLedByChance) {
  std::mt19937_64 engine(7);
  const auto noisy = [&engine](double share) {
    return [&engine, share](int threads, double) {
      const double dice = static_cast<double>(engine() >> 11) * 0x1p-53;
      return 0.75e-3 * (threads > 1 ? share : 1) + (dice < 0.125 ? 3e-3 : 0);
    };
  };
  TeamChoice better = TeamChoice::up_to(2);
  run(better, noisy(0.4), 120);
  EXPECT_GT(better.mean_threads(), 1.8);
  TeamChoice same = TeamChoice::up_to(2);
  run(same, noisy(0.95), 120);
  EXPECT_LT(same.changes(), 16);
  EXPECT_LT(same.trials(), 60);
}

/// Work that grows or shrinks (rows wake, bodies break) is no reason to try again every quarter of a second.
TEST(TeamChoice, LooksSparinglyWhereTheWorkSwings) {
  TeamChoice choice = TeamChoice::up_to(2);
  run(
      choice,
      [](int threads, double t) {
        return (static_cast<long>(t * 2) % 2 == 0 ? 2e-3 : 0.5e-3) * (threads > 1 ? 1.2 : 1);
      },
      120);
  EXPECT_EQ(choice.changes(), 0);
  EXPECT_LT(choice.trials(), 66);
  EXPECT_LT(choice.mean_threads(), 1.03);
}

TEST(TeamChoice, ClimbsToTheNumberThatPays) {
  // Memory bounds it: four threads are best, eight no better, sixteen worse.
  const auto machine = [](int threads, double) {
    return threads == 1 ? 8e-4 : threads == 2 ? 4.4e-4 : threads == 4 ? 2.6e-4 : threads == 8 ? 2.6e-4 : 4e-4;
  };
  TeamChoice choice = TeamChoice::up_to(16);
  run(choice, machine, 10);
  EXPECT_EQ(choice.threads(), 4);
  EXPECT_EQ(choice.changes(), 2);
  TeamChoice odd = TeamChoice::up_to(6);
  run(
      odd, [](int threads, double) { return 1e-3 / threads; }, 10);
  EXPECT_EQ(odd.threads(), 6);
}

TEST(TeamChoice, NeverTriesWhereAPersonChose) {
  for (const int threads : {1, 2, 7}) {
    TeamChoice choice = TeamChoice::always(threads);
    run(choice, of_share(50), 20);
    EXPECT_EQ(choice.threads(), threads);
    EXPECT_EQ(choice.trials(), 0);
    EXPECT_EQ(choice.mean_threads(), threads);
  }
}

/// Whatever is fed to it, also times of zero and of hours.
TEST(TeamChoice, StaysWithinWhatItMayUse) {
  std::mt19937_64 engine(3);
  for (const int most : {1, 2, 3, 5, 16, 256}) {
    TeamChoice choice = TeamChoice::up_to(most);
    for (int n = 0; n < 200000; ++n) {
      ASSERT_GE(choice.threads(), 1);
      ASSERT_LE(choice.threads(), most);
      const auto dice = engine();
      choice.took(dice % 7 == 0    ? 0
                  : dice % 97 == 0 ? 3'600'000'000'000
                                   : static_cast<std::int64_t>(dice % 4'000'000));
    }
  }
}

}  // namespace
}  // namespace palpate::physics
