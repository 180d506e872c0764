#include "haptic_node/tissue/model_trust.h"

#include <gtest/gtest.h>

namespace palpate::haptic {
namespace {

constexpr double h = 1e-3;

/// Answers at a rate, 100 ms late. @param off  of what is foretold at a time, as a ratio @return when it was doubted first; -1: never [s]
template <class Off>
double doubted_at(int every, const Off& off, double until = 5) {
  constexpr std::uint64_t age = 100;
  ModelTrust trust(h);
  for (std::uint64_t n = 1;; ++n) {
    const double t = h * static_cast<double>(n);
    if (t >= until) return -1;
    trust.foretell(n, Vec3(0, 0, 1 + off(t)), Vec3(0, 0, 1));
    if (n > age && n % static_cast<std::uint64_t>(every) == 0) trust.compare(n - age, n, Vec3(0, 0, 1));
    if (trust.doubted(n)) return t;
  }
}

TEST(ModelTrust, DoubtsWhatForetellsWrongly) {
  for (const int every : {1, 10, 50}) {
    EXPECT_EQ(doubted_at(every, [](double) { return 0.2; }), -1) << "within a quarter";
    const double at = doubted_at(every, [](double t) { return t > 1 ? 0.5 : 0.0; });
    EXPECT_GT(at, 1.3) << every;
    EXPECT_LT(at, 1.6) << every;
  }
}

/// The force falls to a fifth: until the answers tell of it, 150 ms, all are off.
TEST(ModelTrust, DoesNotDoubtAfterACut) {
  for (const int every : {1, 10, 50})
    EXPECT_EQ(doubted_at(every, [](double t) { return t > 1 && t < 1.15 ? 4.0 : 0.0; }), -1) << every;
}

TEST(ModelTrust, TrustsAgain) {
  ModelTrust trust(h);
  for (std::uint64_t n = 1; n <= 1000; ++n) {
    trust.foretell(n, Vec3(0, 0, 2), Vec3(0, 0, 1));
    trust.compare(n, n, Vec3(0, 0, 1));
  }
  EXPECT_TRUE(trust.doubted(1000));
  std::uint64_t n = 1000;
  for (; trust.doubted(n) && n < 10'000; ++n) {
    trust.foretell(n, Vec3(0, 0, 1), Vec3(0, 0, 1));
    trust.compare(n, n, Vec3(0, 0, 1));
  }
  EXPECT_NEAR(static_cast<double>(n - 1000) * h, 2.0, 0.5);
}

/// A pulse: the force goes to and fro by itself, and what is foretold is what was known last.
TEST(ModelTrust, DoesNotDoubtWhereTissueMovesByItself) {
  constexpr std::uint64_t age = 100;
  const auto borne = [](std::uint64_t n) {
    return Vec3(0, 0, 1 + 0.6 * std::sin(2 * M_PI * 1.2 * h * static_cast<double>(n)));
  };
  ModelTrust trust(h);
  for (std::uint64_t n = age + 1; n < 5000; ++n) {
    trust.foretell(n, 1.1 * borne(n - age), borne(n - age));
    trust.compare(n - age, n, borne(n - age));
    EXPECT_FALSE(trust.doubted(n));
  }
}

/// Nothing was foretold of it, or hardly anything is felt.
TEST(ModelTrust, ComparesOnlyWhatItCan) {
  ModelTrust trust(h);
  for (std::uint64_t n = 1; n <= 1000; ++n) {
    trust.compare(n, n, Vec3(0, 0, 1));
    trust.foretell(n + 2000, Vec3(0, 0, 0.01), Vec3::Zero());
    trust.compare(n + 2000, n, Vec3(0, 0, 0.04));
  }
  EXPECT_FALSE(trust.doubted(1000));
}

}  // namespace
}  // namespace palpate::haptic
