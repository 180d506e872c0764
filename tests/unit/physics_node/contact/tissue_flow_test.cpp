// What the hand is told of tissue that is viscous or relaxes.

#include <gtest/gtest.h>

#include <string>

#include "tests/support/physics/palpation.h"

namespace palpate::physics::test {
namespace {

Recipe slab_of(double frame_Hz, const char* model, const std::string& material) {
  Recipe recipe = palpated_slab(frame_Hz, model);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\n" + material;
  return recipe;
}

Vec3 press_and_hold(double t) { return palpation(std::min(t, 0.15)); }

/// F_e [N]
double stays(const TouchedTissue& told) {
  double force = pressed(told), all = 1;
  for (std::uint32_t j = 0; j < told.n_branches; ++j) {
    force += told.branches[j].share * told.branches[j].force;
    all += told.branches[j].share;
  }
  return force / all;
}

TEST(TissueFlow, IsNotToldOfWhatDoesNotFlow) {
  for (const char* model : {"fem", "springs"}) {
    Session session(slab_of(1000, model, "viscosity_Pa_s = 1"));
    for (std::uint64_t n = 1; n <= 200; ++n) session.to(n);
    EXPECT_GT(pressed(session.patch.tissues[0]), 0.05);
    EXPECT_EQ(session.patch.tissues[0].n_branches, 0u) << model;
  }
}

/// Of a viscous one g tau = beta; what stays is late by that on a way that goes steadily in.
TEST(TissueFlow, IsToldOfAViscousOne) {
  constexpr double beta = 5e-3;
  for (const char* model : {"fem", "springs"}) {
    Session session(slab_of(1000, model, "viscosity_Pa_s = 100"));
    double earlier = 0;
    for (std::uint64_t n = 1; n <= 140; ++n) {
      session.to(n, press_and_hold);
      if (n == 135) earlier = pressed(session.patch.tissues[0]);
    }
    const TouchedTissue& told = session.patch.tissues[0];
    ASSERT_EQ(told.n_branches, 1u) << model;
    EXPECT_NEAR(told.branches[0].share * told.branches[0].time, beta, 1e-9);
    EXPECT_EQ(told.branches[0].stiffness, 0) << "modes have dampers";
    EXPECT_NEAR(stays(told), earlier, 0.05 * earlier) << model;
    EXPECT_LT(earlier, 0.97 * pressed(told)) << model;
    for (std::uint64_t n = 141; n <= 400; ++n) session.to(n, press_and_hold);
    EXPECT_NEAR(stays(told), pressed(told), 0.01 * pressed(told)) << "held";
  }
}

/// Modes are told as they rest at last, and beside them a branch with what fades; both have the same part of the force.
TEST(TissueFlow, IsToldOfOneThatRelaxes) {
  Session elastic(slab_of(1000, "fem", "viscosity_Pa_s = 1")),
      relaxing(slab_of(1000, "fem", "viscosity_Pa_s = 1\nrelaxation = [[0.4, 0.05]]"));
  for (std::uint64_t n = 1; n <= 600; ++n) {
    elastic.to(n, press_and_hold);
    relaxing.to(n, press_and_hold);
  }
  const TouchedTissue &told = relaxing.patch.tissues[0], &other = elastic.patch.tissues[0];
  ASSERT_EQ(told.n_branches, 1u);
  EXPECT_NEAR(told.branches[0].share, 0.4 / 0.6, 1e-12);
  EXPECT_EQ(told.branches[0].time, 0.05);
  ASSERT_EQ(told.n_modes, other.n_modes);
  double give = 0;
  for (std::uint32_t i = 0; i < told.n_modes; ++i) {
    EXPECT_NEAR(told.modes[i].stiffness, 0.6 * other.modes[i].stiffness, 1e-9 * other.modes[i].stiffness);
    const double along = vec(told.modes[i].psi).dot(vec(told.normal));
    give += along * along / told.modes[i].stiffness;
  }
  EXPECT_NEAR(told.branches[0].stiffness * give, 0.4 / 0.6, 1e-9);
  EXPECT_NEAR(told.branches[0].force, pressed(told), 0.01 * pressed(told)) << "it has relaxed";
  EXPECT_NEAR(told.branches[0].place, told.branches[0].force * give, 1e-12);
  EXPECT_LT(pressed(told), 0.8 * pressed(other));
}

/// It flows in the hand's own time, however seldom physics steps; what was pressed comes back while nothing presses.
TEST(TissueFlow, IsThatOfTheHandsTime) {
  const char* material = "viscosity_Pa_s = 20\nrelaxation = [[0.4, 0.2]]";
  Session often(slab_of(1000, "fem", material)), seldom(slab_of(20, "fem", material));
  for (std::uint64_t n = 1; n <= 600; ++n) {
    often.to(n);
    if (n % 50 != 0) continue;
    seldom.to(n);
    if (n < 150) continue;
    for (std::size_t j = 0; j < 2; ++j) {
      const double one = often.patch.tissues[0].branches[j].force;
      EXPECT_NEAR(seldom.patch.tissues[0].branches[j].force, one, 0.03 * one) << n;
    }
  }
  const double before = often.patch.tissues[0].branches[1].force;
  const auto away = [](double) { return Vec3(0.0005, 0.0005, slab_top + 1e-3); };
  for (std::uint64_t n = 601; n <= 650; ++n) often.to(n, away);
  const double after = often.patch.tissues[0].branches[1].force;
  EXPECT_LT(after, 0.95 * before);
  EXPECT_GT(after, 0.5 * before);
  const auto aside = [](double) { return Vec3(0.0135, 0.0005, slab_top + 1e-3); };
  for (std::uint64_t n = 651; n <= 660; ++n) often.to(n, aside);
  EXPECT_EQ(often.patch.tissues[0].branches[1].force, 0) << "there nothing has been pressed";
}

}  // namespace
}  // namespace palpate::physics::test
