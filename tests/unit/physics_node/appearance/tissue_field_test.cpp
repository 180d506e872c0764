// Strain and stress that colours show: closed forms, and by another way round from where the masses are.
#include "physics_node/appearance/tissue_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/body/build_lattice.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

Recipe cells(const std::string& body = "model = \"fem\"") {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(40, 30, 20);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.3";
  recipe.body = body;
  return recipe;
}

std::unique_ptr<BodyModel> led(const Recipe& recipe, const Eigen::Matrix3d& F) {
  auto moving = make_body_model(body_of(recipe), Precision::double_);
  for (const Index node : moving->body().nodes()) {
    const Vec3 rest = moving->body().rest_position(node);
    moving->place(node, F * rest - rest, Vec3::Zero());
  }
  return moving;
}

void expect_everywhere(const BodyModel& moving, ColourKind kind, double value, double within) {
  const auto field = TissueField::of(moving, kind);
  ASSERT_NE(field, nullptr);
  for (const Index node : moving.body().nodes()) ASSERT_NEAR(field->at(node), value, within);
}

std::vector<Recipe> of_both_kinds() {
  Recipe mesh = mesh_box({4, 3, 2}, 0.008);
  mesh.material = cells().material;
  return {cells(), mesh};
}

TEST(TissueField, IsNothingWhereTissueOnlyTurns) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Recipe& recipe : of_both_kinds())
    for (const ColourKind kind : {ColourKind::strain, ColourKind::stress})
      expect_everywhere(*led(recipe, R), kind, 0, kind == ColourKind::strain ? 1e-12 : 1e-8);
}

TEST(TissueField, IsNothingWhereItOnlySwells) {
  for (const Recipe& recipe : of_both_kinds())
    for (const ColourKind kind : {ColourKind::strain, ColourKind::stress})
      expect_everywhere(*led(recipe, 1.2 * Eigen::Matrix3d::Identity()), kind, 0,
                        kind == ColourKind::strain ? 1e-12 : 1e-8);
}

/// A bar of modulus E that is a little longer by e: strain 2/3 (1 + nu) e, stress E e.
TEST(TissueField, IsThatOfABar) {
  const double e = 1e-5, nu = 0.3;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 0) += e, F(1, 1) -= nu * e, F(2, 2) -= nu * e;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vec3(3, -1, 1).normalized()).toRotationMatrix();
  for (const Recipe& recipe : of_both_kinds()) {
    expect_everywhere(*led(recipe, R * F), ColourKind::strain, 2.0 / 3 * (1 + nu) * e, 1e-9);
    expect_everywhere(*led(recipe, R * F), ColourKind::stress, 1e4 * e, 1e-4 * 1e4 * e);
  }
}

/// Pressed together from all sides by e: p = K (3 e), K = E / (3 (1 - 2 nu)); a bar pressed by e: E e / 3. None where it is pulled.
TEST(TissueField, PressureIsThatOfPressedTissue) {
  const double e = 1e-5, nu = 0.3, E = 1e4;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vec3(3, -1, 1).normalized()).toRotationMatrix();
  Eigen::Matrix3d bar = Eigen::Matrix3d::Identity();
  bar(0, 0) -= e, bar(1, 1) += nu * e, bar(2, 2) += nu * e;
  for (const Recipe& recipe : of_both_kinds()) {
    expect_everywhere(*led(recipe, (1 - e) * R), ColourKind::pressure, E * e / (1 - 2 * nu), 1e-3 * E * e);
    expect_everywhere(*led(recipe, R * bar), ColourKind::pressure, E * e / 3, 1e-3 * E * e);
    expect_everywhere(*led(recipe, R * bar.inverse()), ColourKind::pressure, 0, 0);
    expect_everywhere(*led(recipe, R), ColourKind::pressure, 0, 1e-8);
  }
}

/// Simple shear by g: E12 = g / 2, E22 = g^2 / 2; of neo-Hookean s12 = mu g, s11 - s22 = mu g^2.
TEST(TissueField, IsThatOfShear) {
  const double g = 0.4, mu = 1e4 / 2.6;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 1) = g;
  const double dev = (g * g / 2) * (g * g / 2) * 2 / 3 + 2 * g * g / 4;  // E':E'
  for (const Recipe& recipe : of_both_kinds()) {
    expect_everywhere(*led(recipe, F), ColourKind::strain, std::sqrt(2.0 / 3 * dev), 1e-12);
    const double s12 = mu * g, s11 = mu * g * g;
    expect_everywhere(*led(recipe, F), ColourKind::stress, std::sqrt(s11 * s11 + 3 * s12 * s12), 1e-8);
  }
}

TEST(TissueField, OfGreenIsThatOfItsLaw) {
  Recipe recipe = cells();
  recipe.material += "\nlaw = \"green\"";
  const double g = 0.2, mu = 1e4 / 2.6, lambda = 1e4 * 0.3 / (1.3 * 0.4);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 1) = g;
  const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d S = lambda * E.trace() * Eigen::Matrix3d::Identity() + 2 * mu * E;
  const Eigen::Matrix3d s = F * S * F.transpose();
  const Eigen::Matrix3d dev = s - s.trace() / 3 * Eigen::Matrix3d::Identity();
  expect_everywhere(*led(recipe, F), ColourKind::stress, std::sqrt(1.5) * dev.norm(), 1e-8);
}

TEST(TissueField, IsThatOfEachMaterial) {
  Recipe recipe = cells(
      "model = \"fem\"\nregions = [{ material = \"hard\", box_min_mm = [0, -99, -99], box_max_mm = [99, 99, "
      "99] }]");
  recipe.world = "[material.hard]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 40\npoisson_ratio = 0.3\n";
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 1) = 1e-6;
  const auto moving = led(recipe, F);
  const auto field = TissueField::of(*moving, ColourKind::stress);
  for (const Index node : moving->body().nodes()) {
    const double x = moving->body().rest_position(node).x();
    const double soft = std::sqrt(3.0) * 1e4 / 2.6 * 1e-6;
    if (std::abs(x) < 1e-9)
      EXPECT_NEAR(field->at(node), 2.5 * soft, 1e-3 * soft);
    else
      EXPECT_NEAR(field->at(node), x < 0 ? soft : 4 * soft, 1e-3 * soft);
  }
}

TEST(TissueField, IsOfWhatHasIt) {
  const auto has = [](const Recipe& recipe, ColourKind kind) {
    const auto moving = make_body_model(body_of(recipe), Precision::double_);
    return TissueField::of(*moving, kind) != nullptr;
  };
  EXPECT_FALSE(has(cells(), ColourKind::own));
  EXPECT_FALSE(has(cells(), ColourKind::displacement));
  Recipe springs = cells("");
  springs.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  EXPECT_TRUE(has(springs, ColourKind::strain));
  EXPECT_FALSE(has(springs, ColourKind::stress));
  EXPECT_FALSE(has(Recipe{}, ColourKind::strain));  // fcc
  EXPECT_TRUE(has(Recipe{}, ColourKind::awake));
  Recipe clay = cells();
  clay.material += "\nyield_ratio = 1.1\nk2_ratio = 0.1";
  EXPECT_TRUE(has(clay, ColourKind::strain));
  EXPECT_FALSE(has(clay, ColourKind::stress));
  EXPECT_FALSE(has(clay, ColourKind::pressure));
  EXPECT_TRUE(has(cells(), ColourKind::pressure));
}

/// As many of its masses as do not sleep, and those under the finger.
TEST(TissueField, TellsWhatIsAwake) {
  World world(scene_of(pressed_slab_recipe()));
  const BodyModel& moving = world.body(0);
  const auto field = TissueField::of(moving, ColourKind::awake);
  const auto awake = [&] {
    double sum = 0;
    for (const Index node : moving.body().nodes()) sum += field->at(node);
    return sum / static_cast<double>(moving.body().n_nodes());
  };
  for (int n = 0; n < 600; ++n) world.frame({});
  EXPECT_EQ(moving.sleeping_fraction(), 1);
  EXPECT_EQ(awake(), 0);
  run(world, steady_hand({0, 0, 0.3}), 20);
  EXPECT_LT(moving.sleeping_fraction(), 1);
  EXPECT_NEAR(awake(), 1 - moving.sleeping_fraction(), 1e-12);
  const Body& body = moving.body();
  const auto highest = std::ranges::max_element(body.nodes(), {}, [&](Index n) {
    return body.rest_position(n).z() - body.rest_position(n).head<2>().norm();
  });
  EXPECT_EQ(field->at(*highest), 1);
}

/// What the eye gets of a slab under a finger is the strain of the positions that it could measure itself.
TEST(TissueField, ReachesTheEyeAsThePositionsHaveIt) {
  Recipe recipe = pressed_slab_recipe();
  recipe.body += "\nmodel = \"fem\"";
  Scene scene = scene_of(recipe);
  scene.render->colour = ColourKind::strain;
  World world(scene);
  run(world, steady_hand({0, 0, 0.3}), 600);
  const BodyModel& moving = world.body(0);
  Appearance appearance(world, std::nullopt);
  appearance.poll();
  std::vector<double> told;
  std::vector<Array3f> place;
  double most = 0;
  appearance.write_blocks([&](const VertexBlock& block) {
    for (std::uint32_t n = 0; n < block.n_vertices; ++n) {
      told.push_back(block.field[n] / 255.0 * static_cast<double>(block.field_most));
      place.push_back(block.position[n]);
    }
    most = std::max(most, static_cast<double>(block.field_most));
  });
  ASSERT_GT(most, 0.02);
  // By differences of where the masses are, over all cells at each.
  const Body& body = moving.body();
  const double h = body.spacing();
  std::size_t compared = 0;
  for (std::size_t v = 0; v < told.size(); ++v) {
    const Vec3 p(place[v][0], place[v][1], place[v][2]);
    const auto nearest =
        std::ranges::min_element(body.nodes(), {}, [&](Index n) { return (moving.position(n) - p).norm(); });
    const Vec3i grid = body.lattice.grid_of(*nearest);
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    int n_cells = 0;
    for (int o = 0; o < 8; ++o) {
      const Vec3i low = grid - Vec3i(o & 1, o >> 1 & 1, o >> 2);
      std::array<Index, 8> at;
      bool whole = true;
      for (int c = 0; c < 8; ++c) {
        at[static_cast<std::size_t>(c)] = body.lattice.mass_at(low + Vec3i(c & 1, c >> 1 & 1, c >> 2));
        whole = whole && at[static_cast<std::size_t>(c)] >= 0;
      }
      if (!whole) continue;
      ++n_cells;
      for (int axis = 0; axis < 3; ++axis)
        for (std::size_t c = 0; c < 8; ++c)
          if ((c >> axis & 1) == 0)
            F.col(axis) += (moving.position(at[c | 1U << axis]) - moving.position(at[c])) / (4 * h);
    }
    F /= n_cells;
    const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d dev = E - E.trace() / 3 * Eigen::Matrix3d::Identity();
    EXPECT_NEAR(told[v], std::sqrt(2.0 / 3) * dev.norm(), 0.005 * most);
    ++compared;
  }
  EXPECT_GT(compared, 100u);
  // Switched off, it is told as nothing.
  appearance.set_colour(ColourKind::own);
  appearance.write_blocks([](const VertexBlock& block) { EXPECT_EQ(block.field_most, 0.0F); });
}

}  // namespace
}  // namespace palpate::physics
