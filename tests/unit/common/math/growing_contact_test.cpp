#include "common/math/growing_contact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate {
namespace {

constexpr double E = 12e3, rho = 5e-3;  // E' [Pa], rho [m]

/// dF/dz = 2 E' a with a^2 = a_0^2 + rho z, which is what it is made from.
TEST(GrowingContact, IsAsStiffAsThePatchIsWide) {
  for (const double patch : {0.2e-3, 2e-3, 10e-3}) {
    const GrowingContact law = GrowingContact::of_ball(E, patch, rho);
    for (const double F : {0.0, 1e-6, 0.01, 0.3, 20.0}) {
      const double a = std::sqrt(patch * patch + rho * law.give(F));
      EXPECT_NEAR(law.slope(F) * 2 * E * a, 1, 1e-12) << patch << " " << F;
      EXPECT_NEAR(law.slope_at(law.give(F)), law.slope(F), 1e-12 * law.slope(F));
      const GrowingContact::Tangent z = law.tangent(F);
      EXPECT_EQ(z.slope, law.slope(F));
      EXPECT_NEAR(z.offset + z.slope * F, law.give(F), 1e-12 * law.give(F));
    }
  }
}

TEST(GrowingContact, IsThatOfHertzOnASmallPatch) {
  const GrowingContact law = GrowingContact::of_ball(E, 1e-7, rho);
  for (const double z : {0.1e-3, 1e-3, 3e-3}) {
    const double F = 4.0 / 3 * E * std::sqrt(rho) * std::pow(z, 1.5);
    EXPECT_NEAR(law.give(F), z, 1e-6 * z);
    EXPECT_NEAR(law.energy(F), 0.4 * F * z, 1e-6 * F * z) << "the integral of z^1.5";
  }
}

TEST(GrowingContact, IsASpringWhereItDoesNotGrow) {
  const GrowingContact flat = GrowingContact::of_ball(E, 3e-3, 0);
  EXPECT_EQ(flat.growth, 0);
  for (const double F : {0.0, 0.1, 5.0}) {
    EXPECT_NEAR(flat.give(F), F / (2 * E * 3e-3), 1e-15);
    EXPECT_NEAR(flat.energy(F), 0.5 * F * flat.give(F), 1e-15);
  }
  const GrowingContact hardly{flat.compliance, 1e-13};
  EXPECT_NEAR(hardly.give(0.3), flat.give(0.3), 1e-14) << "nothing cancels";
  EXPECT_NEAR(hardly.energy(0.3), flat.energy(0.3), 1e-14);
}

TEST(GrowingContact, StoresWhatTheForceDoes) {
  const GrowingContact law = GrowingContact::of_ball(E, 1e-3, rho);
  double work = 0;
  constexpr int n = 20'000;
  constexpr double most = 0.5;
  for (int i = 0; i < n; ++i) {
    const double a = most * i / n, b = most * (i + 1) / n;
    work += 0.5 * (a + b) * (law.give(b) - law.give(a));
  }
  EXPECT_NEAR(law.energy(most), work, 1e-7 * work);
}

}  // namespace
}  // namespace palpate
