// The element law beyond yield, against its closed form.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "physics_node/step/lattice/element_step.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

// k1 = 1000 N/m, k2 = 200 N/m, L = 1 m, m = 1 kg, y_p = 1.05.
const char* const metal =
    "mass_g = 1000\nk1_N_per_m = 1000\nk2_ratio = 0.2\nyield_ratio = 1.05\nbreak_ratio = 1.5";

/// A pair of masses pulled apart by hand.
class Pair {
 public:
  explicit Pair(const std::string& material = metal)
      : body_(body_of(pair_of_masses(material))), state_(body_) {}

  void set_length(double l) { write(state_.u, second(), (l - 1) * along_); }
  std::int64_t commit() { return element_step(body_, state_, {.dt = 0}); }
  /// Stretches from one length to another, committing after each increment.
  void pull(double from, double to, int increments) {
    for (int n = 1; n <= increments; ++n) {
      set_length(from + (to - from) * n / increments);
      commit();
    }
  }
  /// Tension now: what moves the first mass toward the second.
  double tension(double rate = 0) {
    Three<double>& v = state_.v;
    write(v, first(), Vec3::Zero());
    write(v, second(), rate * along_);
    const Vec3 u0 = read(state_.u, first());
    const Vec3 u1 = read(state_.u, second());
    element_step(body_, state_, {.dt = 1.0});
    const double f = read(state_.v, first()).dot(along_);
    write(state_.u, first(), u0);
    write(state_.u, second(), u1);
    return f;
  }
  double l_c() const { return state_.l_c[0][static_cast<std::size_t>(first())]; }
  double y_p() const { return 1.05 + state_.hardening[0][static_cast<std::size_t>(first())]; }  // L = 1 m
  Mask mask(int end) const { return state_.mask[static_cast<std::size_t>(end == 0 ? first() : second())]; }
  bool yielded(int end) const { return has_yielded(body_, state_, end == 0 ? first() : second()); }

 private:
  Index first() const { return body_.lattice.masses[0]; }
  Index second() const { return body_.lattice.masses[1]; }
  Body body_;
  LatticeState<double> state_;
  Vec3 along_ = Vec3(1, 1, 0).normalized();
};

TEST(ElementLaw, IsTheSameForAnyNumberOfIncrements) {
  for (const int increments : {1, 10, 1000}) {
    Pair pair;
    pair.pull(1, 1.10, increments);
    EXPECT_NEAR(pair.l_c(), 0.04, 1e-12) << increments;
    EXPECT_NEAR(pair.y_p(), 1.10, 1e-12) << increments;
    EXPECT_NEAR(pair.tension(), 60.0, 1e-9) << increments;
  }
}

TEST(ElementLaw, UnloadsElasticallyToItsPlasticStretch) {
  Pair pair;
  pair.pull(1, 1.10, 10);
  pair.set_length(1.04);
  EXPECT_NEAR(pair.tension(), 0, 1e-9);
  pair.set_length(1.0);
  EXPECT_NEAR(pair.tension(), -40, 1e-9);  // compressed against the stretch that stayed
  EXPECT_EQ(pair.commit(), 0);
  EXPECT_NEAR(pair.l_c(), 0.04, 1e-12);
  pair.set_length(1.09);
  EXPECT_NEAR(pair.tension(), 50, 1e-9);
}

TEST(ElementLaw, YieldsAgainFromWhereItStopped) {
  Pair pair;
  pair.pull(1, 1.10, 10);
  pair.set_length(1);
  pair.commit();
  pair.pull(1, 1.20, 10);  // f = 60 + 200 (1.20 - 1.10)
  EXPECT_NEAR(pair.tension(), 80, 1e-9);
  EXPECT_NEAR(pair.l_c(), 0.20 - 0.08, 1e-12);
}

TEST(ElementLaw, KeepsViscosityOutOfThePlasticStretch) {
  Pair pair(std::string(metal) + "\nviscosity_N_s_per_m = 20");
  pair.set_length(1.10);
  EXPECT_NEAR(pair.tension(1.0), 60 + 20, 1e-9);
  pair.commit();
  EXPECT_NEAR(pair.l_c(), 0.04, 1e-12);
  EXPECT_NEAR(pair.tension(1.0), 60 + 20, 1e-9);
  EXPECT_NEAR(pair.tension(-1.0), 60 - 20, 1e-9);
}

TEST(ElementLaw, DoesNotYieldInCompression) {
  Pair pair;
  pair.pull(1, 0.5, 10);
  EXPECT_EQ(pair.l_c(), 0);
  EXPECT_NEAR(pair.tension(), -500, 1e-9);
  EXPECT_FALSE(pair.yielded(0));
  EXPECT_FALSE(pair.yielded(1));
}

TEST(ElementLaw, BreaksForGoodAtBothEnds) {
  Pair pair;
  ASSERT_EQ(std::popcount(pair.mask(0)), 1);
  ASSERT_EQ(std::popcount(pair.mask(1)), 1);
  pair.set_length(1.5001);
  EXPECT_EQ(pair.commit(), 1);
  EXPECT_EQ(pair.mask(0), 0);
  EXPECT_EQ(pair.mask(1), 0);
  EXPECT_EQ(pair.tension(), 0);
  pair.set_length(1.02);
  EXPECT_EQ(pair.commit(), 0);
  EXPECT_EQ(pair.tension(), 0);
}

/// One cell of the voxel lattice, 1 m wide, whose corner (1, 0, 0) is pulled along x: its axis element has exact lengths.
class PulledCorner : public testing::Test {
 protected:
  static Recipe recipe() {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(1000, 1000, 1000);
    recipe.spacing_mm = 1000;
    recipe.material = "mass_g = 1\nk1_N_per_m = 1\nyield_ratio = 1.25\nbreak_ratio = 1.5";
    return recipe;
  }
  void pull(double by) { write(state_.u, corner_, Vec3(by, 0, 0)); }
  std::int64_t step() { return element_step(body_, state_, {.dt = 0}); }
  bool alive(Index cell, int direction) const {
    return (state_.mask[static_cast<std::size_t>(cell)] >> direction & 1) != 0;
  }
  Body body_ = body_of(recipe());
  LatticeState<double> state_{body_};
  Index origin_ = body_.lattice.cell_of({0, 0, 0});
  Index corner_ = body_.lattice.cell_of({1, 0, 0});
};

TEST_F(PulledCorner, IsStillElasticExactlyAtYield) {
  pull(0.25);
  EXPECT_EQ(step(), 0);
  EXPECT_FALSE(has_yielded(body_, state_, origin_));
  pull(std::nextafter(0.25, 1.0) + 1e-15);
  step();
  EXPECT_TRUE(has_yielded(body_, state_, origin_));
}

TEST_F(PulledCorner, StillHoldsExactlyAtItsBreakRatio) {
  pull(0.5);
  EXPECT_EQ(step(), 0);
  EXPECT_TRUE(alive(origin_, 0));
  EXPECT_TRUE(alive(corner_, body_.lattice.n_half));
  pull(0.5 + 1e-15);
  EXPECT_EQ(step(), 1);
  EXPECT_FALSE(alive(origin_, 0));
  EXPECT_FALSE(alive(corner_, body_.lattice.n_half));
}

TEST(ElementLaw, AgreesAtBothEndsAfterACrash) {
  for (const char* lattice : {"fcc", "voxel"}) {
    Recipe recipe;
    recipe.lattice = lattice;
    recipe.material += "\nk2_ratio = 0.2\nyield_ratio = 1.05\nbreak_ratio = 1.1";
    const Body body = body_of(recipe);
    LatticeState<float> state(body);
    shake(body, state, 1.0, 6);
    std::int64_t broken = 0;
    for (int n = 0; n < 200; ++n) {
      broken += element_step(body, state, {.dt = 2e-4});
    }
    std::int64_t ends = 0;
    for (const Index cell : body.lattice.masses) {
      const Mask mask = state.mask[static_cast<std::size_t>(cell)];
      const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(cell))];
      for (int d = 0; d < 2 * body.lattice.n_half; ++d) {
        if ((mask >> d & 1) == 0) continue;
        ++ends;
        const Index other = cell + offset[static_cast<std::size_t>(d)];
        const int back = (d + body.lattice.n_half) % (2 * body.lattice.n_half);
        ASSERT_TRUE(state.mask[static_cast<std::size_t>(other)] >> back & 1) << lattice;
      }
    }
    EXPECT_GT(broken, 10) << lattice;
    EXPECT_EQ(ends / 2 + broken, body.lattice.n_elements()) << lattice;
  }
}

}  // namespace
}  // namespace palpate::physics::test
