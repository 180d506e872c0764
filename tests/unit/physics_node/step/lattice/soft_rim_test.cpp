// The rim against what it stands for: a point force in an unbounded body.
#include "physics_node/step/lattice/soft_rim.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Recipe;

/// A cube of 15 cells of 10 mm, of which the 7 in the middle act.
class SoftRimTest : public testing::TestWithParam<double> {
 protected:
  static constexpr double E = 1e4, h = 0.01;
  SoftRimTest() {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(150, 150, 150);
    recipe.material =
        "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = " + std::to_string(GetParam());
    recipe.body = "model = \"fem\"";
    body_ = std::make_unique<Body>(test::body_of(recipe));
    body_->solid->awake_radius = 0.03;
    index_masses(body_->lattice, Rows::in_segments);
    state_ = std::make_unique<LatticeState<double>>(*body_);
    grid_ = make_hex_grid(*body_);
    marks_.assign(static_cast<std::size_t>(body_->capacity()), 0);
    for (std::size_t r = 0; r < grid_.runs.size(); ++r) acting_.push_back(static_cast<Index>(r));
  }
  void choose() {
    for (std::size_t r = 0; r < grid_.runs.size(); ++r)
      for (Index i = grid_.runs[r].first; i < grid_.runs[r].first + grid_.runs[r].count; ++i) {
        if (body_->solid->stiffness[static_cast<std::size_t>(i)] <= 0) continue;
        const Vec3 middle = body_->rest_position(i) + Vec3::Constant(0.5 * h);
        if (middle.cwiseAbs().maxCoeff() < 0.036) marks_[static_cast<std::size_t>(i)] = cell_acts;
      }
  }
  std::unique_ptr<Body> body_;
  std::unique_ptr<LatticeState<double>> state_;
  HexGrid grid_;
  std::vector<std::uint8_t> marks_;
  std::vector<Index> acting_;
};

/// Kelvin: u = ((3 - 4 nu) P / r + (P . x) x / r^3) / (16 pi mu (1 - nu)). What flows through the border is the force itself, so the sum of
/// all pulls of the rim at that displacement is the force.
TEST_P(SoftRimTest, HoldsAPointForce) {
  choose();
  SoftRim<double> rim(*body_);
  rim.find(*body_, grid_, acting_, marks_, *state_);
  const PressedPlace place{.at = Vec3(0, 0, 0), .weight = 1};
  rim.stiffen(*body_, std::span(&place, 1));
  ASSERT_GT(rim.size(), 200U);
  const double nu = GetParam(), mu = E / (2 * (1 + nu));
  const Vec3 P(0.3, -0.2, 1);
  for (const Index node : body_->nodes()) {
    const Vec3 x = body_->rest_position(node);
    const double r = std::max(x.norm(), 0.5 * h);
    const Vec3 u =
        ((3 - 4 * nu) / r * P + P.dot(x) / (r * r * r) * x) / (16 * std::numbers::pi * mu * (1 - nu));
    for (std::size_t a = 0; a < 3; ++a)
      state_->u[a][static_cast<std::size_t>(node)] = u[static_cast<Eigen::Index>(a)];
  }
  rim.act(*state_, 1e-4, true);
  Vec3 sum = Vec3::Zero();
  for (const Index node : body_->nodes()) sum -= vector_of(state_->f, node);
  EXPECT_NEAR((sum - P).norm(), 0, 0.02 * P.norm())
      << sum.transpose();  // the border is of 7 x 7 faces a side
  EXPECT_NEAR(rim.watched_elastic(), rim.elastic(*state_), 1e-12);
  EXPECT_GT(rim.elastic(*state_), 0);
}

TEST_P(SoftRimTest, TakesEnergyByItsDampersOnly) {
  choose();
  SoftRim<double> rim(*body_);
  rim.find(*body_, grid_, acting_, marks_, *state_);
  const PressedPlace place{.at = Vec3(0, 0, 0), .weight = 1};
  rim.stiffen(*body_, std::span(&place, 1));
  test::Dice dice(3);
  for (const Index node : body_->nodes())
    for (std::size_t a = 0; a < 3; ++a) state_->v[a][static_cast<std::size_t>(node)] = dice.between(-1, 1);
  state_->dt_before = 1e-4;
  rim.act(*state_, 1e-4, false);
  double power = 0;
  for (const Index node : body_->nodes()) power += vector_of(state_->f, node).dot(vector_of(state_->v, node));
  EXPECT_LT(power, 0);
  EXPECT_NEAR(rim.lost(), -0.5 * 1e-4 * power, 1e-9 * std::abs(power));  // of the first step half
  EXPECT_NEAR(rim.due(*state_), -1e-4 * power, 1e-9 * std::abs(power));
  EXPECT_EQ(rim.elastic(*state_), 0);
}

TEST_P(SoftRimTest, IsTheMeanOfPlacesByForce) {
  choose();
  SoftRim<double> one(*body_), two(*body_);
  for (auto* rim : {&one, &two}) rim->find(*body_, grid_, acting_, marks_, *state_);
  const PressedPlace place{.at = Vec3(0.01, 0, 0), .weight = 1};
  const std::array<PressedPlace, 2> places{place, {.at = Vec3(-0.02, 0, 0), .weight = 0}};
  one.stiffen(*body_, std::span(&place, 1));
  two.stiffen(*body_, places);  // the second is let go: it counts for nothing beside one that is pressed
  for (const Index node : body_->nodes()) state_->u[2][static_cast<std::size_t>(node)] = 1e-3;
  EXPECT_NEAR(one.elastic(*state_), two.elastic(*state_), 1e-12 * one.elastic(*state_));
}

/// What is held stiffens the rim where the push goes, not where it comes by.
TEST_P(SoftRimTest, IsStifferBeforeWhatIsHeld) {
  choose();
  for (const Index node : body_->nodes())
    if (body_->rest_position(node).z() < -0.07) body_->inverse_mass[static_cast<std::size_t>(node)] = 0;
  SoftRim<double> rim(*body_);
  rim.find(*body_, grid_, acting_, marks_, *state_);
  for (const Index node : body_->nodes()) state_->u[2][static_cast<std::size_t>(node)] = 1e-3;
  const auto pushed = [&](const Vec3& push) {
    const PressedPlace place{.at = Vec3::Zero(), .weight = 1, .push = push};
    rim.stiffen(*body_, std::span(&place, 1));
    return rim.elastic(*state_);
  };
  const double down = pushed(Vec3(0, 0, -1)), aside = pushed(Vec3(1, 0, 0)), up = pushed(Vec3(0, 0, 1));
  EXPECT_NEAR(aside, up, 1e-12 * up);
  EXPECT_GT(down, 1.5 * up);
  EXPECT_LT(down, 4 * up);
}

INSTANTIATE_TEST_SUITE_P(Poisson, SoftRimTest, testing::Values(0.25, 0.45, 0.49));

}  // namespace
}  // namespace palpate::physics
