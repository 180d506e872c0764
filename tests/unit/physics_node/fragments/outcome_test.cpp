// Which measures make which outcome, and what is measured of the pieces.
#include "physics_node/fragments/outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "physics_node/fragments/measure_fragments.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// The sphere of the falls: a plane through its middle cuts a fifteenth of its elements.
OutcomeMeasures touched(double broken, double yielded, double largest, double second, double shape) {
  return {.touched = true,
          .broken = broken,
          .cut = 15 * broken,
          .yielded = yielded,
          .largest = largest,
          .second = second,
          .shape = shape};
}

TEST(Outcome, FollowsFromTheMeasures) {
  EXPECT_EQ(classify({}), Outcome::original);
  EXPECT_EQ(classify(touched(0, 0, 1, 0, 0.02)), Outcome::restitution);
  EXPECT_EQ(classify(touched(0.01, 0.3, 1, 0.001, 0.05)), Outcome::restitution);
  // The five spheres that the table of thresholds begins with.
  EXPECT_EQ(classify(touched(0.29, 0.9, 0.82, 0.01, 1)), Outcome::crack);
  EXPECT_EQ(classify(touched(0.5, 1, 0.45, 0.40, 1)), Outcome::disunion);
  EXPECT_EQ(classify(touched(0.01, 0.98, 1, 0, 1)), Outcome::crush);
  EXPECT_EQ(classify(touched(0.998, 1, 0.002, 0.002, 0)), Outcome::smash);
  // Edges.
  EXPECT_EQ(classify(touched(0.5, 1, 0.88, 0.11, 1)), Outcome::disunion) << "a second part";
  EXPECT_EQ(classify(touched(0.5, 1, 0.7, 0.01, 1)), Outcome::disunion) << "a third has gone, in splinters";
  EXPECT_EQ(classify(touched(0.03, 0.1, 0.86, 0.07, 0.1)), Outcome::disunion)
      << "a bar in three pieces, its ends short";
  EXPECT_EQ(classify(touched(0.6, 1, 0.3, 0.28, 1)), Outcome::disunion) << "three parts and splinters";
  EXPECT_EQ(classify(touched(0.9, 1, 0.09, 0.08, 1)), Outcome::smash);
  EXPECT_EQ(classify(touched(0, 0, 1, 0, 0.3)), Outcome::crush) << "turned over, though nothing has yielded";
  EXPECT_NE(classify({.broken = 0.1}), Outcome::original) << "broken by its own weight";
}

/// Where a mass at p is while the bar is cut.
using Opening = std::function<Vec3(const Vec3& p)>;

/// A bar of soft tissue, 12 times as long as thick, opened and closed again: what was stretched too far has broken.
OutcomeMeasures cut_bar(double spacing_mm, const Opening& opening) {
  Recipe recipe;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nyield_ratio = 1.05\nbreak_ratio = 1.1";
  recipe.shape = Recipe::box(240, 20, 20);
  recipe.spacing_mm = spacing_mm;
  const auto moving = make_body_model(body_of(recipe), Precision::double_);
  Fragments fragments(*moving);
  moving->advance({.dt = 0}, {});
  for (const Opening& place : {opening, Opening([](const Vec3& p) { return p; })}) {
    for (const Index cell : moving->body().lattice.masses) {
      const Vec3 p = moving->body().lattice.rest_position(cell);
      moving->place(cell, place(p) - p, Vec3::Zero());
    }
    moving->advance({.dt = 0}, {});
    fragments.update(*moving);
  }
  OutcomeMeasures measures = measure_outcome(*moving, &fragments);
  measures.touched = true;
  return measures;
}

/// Pulled apart at these places along it.
Opening gaps(std::initializer_list<double> at) {
  return [at = std::vector<double>(at)](const Vec3& p) {
    const auto before = std::count_if(at.begin(), at.end(), [&](double x) { return p.x() > x; });
    return Vec3(p + Vec3(0.05 * static_cast<double>(before), 0, 0));
  };
}

/// Bent open about a line at z, in the middle: cut down to there.
Opening bend(double z) {
  return [z](const Vec3& p) {
    const Vec3 hinge(0.003, 0, z);
    if (p.x() < hinge.x()) return p;
    return Vec3(hinge + Eigen::AngleAxisd(0.5, -Vec3::UnitY()) * (p - hinge));
  };
}

TEST(Outcome, OfABarInPiecesIsDisunionHoweverFineItIs) {
  for (const double spacing_mm : {10.0, 5.0, 3.3}) {
    const OutcomeMeasures three = cut_bar(spacing_mm, gaps({-0.101, 0.101}));  // the ends hold 8 % each
    EXPECT_EQ(three.fragments, 3);
    EXPECT_GT(three.largest, 0.75);
    EXPECT_EQ(classify(three), Outcome::disunion)
        << spacing_mm << " mm: " << three.largest << " " << three.second;
    EXPECT_NEAR(three.cut, 2, 0.35) << "two cuts";
    EXPECT_EQ(classify(cut_bar(spacing_mm, gaps({0.003}))), Outcome::disunion);
  }
}

TEST(Outcome, OfABodyCutHalfThroughIsACrackHoweverFineItIs) {
  for (const double spacing_mm : {10.0, 5.0, 3.3}) {
    const OutcomeMeasures half = cut_bar(spacing_mm, bend(-0.002));
    EXPECT_EQ(half.fragments, 1);
    EXPECT_LT(half.broken, 0.1);
    EXPECT_EQ(classify(half), Outcome::crack) << spacing_mm << " mm: " << half.cut;
  }
}

TEST(FragmentMeasures, AddUpToTheBody) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 200\nyield_ratio = 1.0005\nbreak_ratio = 1.001";
  recipe.shape = Recipe::box(60, 40, 40);
  const auto moving = make_body_model(body_of(recipe), Precision::double_);
  Fragments fragments(*moving);
  moving->advance({.dt = 0}, {});
  for (const Index cell : moving->body().lattice.masses) {
    const Vec3 p = moving->body().lattice.rest_position(cell);
    const bool right = p.x() > 0.01;
    moving->place(cell, right ? Vec3(0.02, 0, 0) : Vec3::Zero(), right ? Vec3(1, 2, 3) : Vec3(0, 0, -1));
  }
  moving->advance({.dt = 0}, {});
  fragments.update(*moving);
  const auto pieces = measure_fragments(*moving, fragments);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_GT(pieces[0].mass, pieces[1].mass);
  EXPECT_GT(pieces[1].center.x(), pieces[0].center.x());
  EXPECT_EQ(pieces[0].masses + pieces[1].masses, moving->body().lattice.n_masses());
  EXPECT_NEAR(pieces[1].momenta.linear.z(), 3 * pieces[1].mass, 1e-12);
  const Momenta sum = moving->momenta();
  EXPECT_NEAR((pieces[0].momenta.linear + pieces[1].momenta.linear - sum.linear).norm(), 0, 1e-12);
  EXPECT_NEAR((pieces[0].momenta.angular + pieces[1].momenta.angular - sum.angular).norm(), 0, 1e-12);
  // Each piece has moved as a whole: its shape is what it was, that of the body is not.
  EXPECT_NEAR(fragment_shape_rms(*moving, fragments, pieces[0].label), 0, 1e-12);
  EXPECT_GT(moving->counts().shape_rms, 1e-3);
}

}  // namespace
}  // namespace palpate::physics::test
