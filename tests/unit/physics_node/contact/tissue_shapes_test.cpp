// Shapes where the tissue under them is no plane: wider than the body, tilted on it, in a hollow of it.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/physics/palpation.h"

namespace palpate::physics::test {
namespace {

/// Of a column that is narrower than what presses it nothing but the top counts: neither its sides nor what of the plate hangs over.
TEST(TissueShapes, BearsTheSameUnderAPlateHoweverFarThatReachesBeyondTheBody) {
  for (const char* words :
       {"shape = \"box\"\nsize_mm = [22, 22, 10]", "shape = \"box\"\nsize_mm = [60, 60, 10]",
        "shape = \"box\"\nsize_mm = [54, 300, 10]", "shape = \"cylinder\"\nradius_mm = 29\nlength_mm = 30",
        "shape = \"cylinder\"\nradius_mm = 100\nlength_mm = 30"})
    for (const double aside : {0.0, 2e-3}) {
      Recipe recipe = palpated_by(words);
      recipe.shape = Recipe::box(20, 20, 40);
      recipe.spacing_mm = 5;
      recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\npoisson_ratio = 0\nviscosity_Pa_s = 10";
      Session session(recipe);
      const auto held = [&](double t) {
        return Vec3(aside, 0, 0.0205 - 0.0015 * std::clamp((t - 0.05) / 0.1, 0.0, 1.0));
      };
      for (std::uint64_t n = 1; n <= 500; ++n) session.to(n, held);
      ASSERT_EQ(session.patch.n_tissues, 1u) << words;
      const TouchedTissue& told = session.patch.tissues[0];
      const double force = pressed(told), k = 20e3 * 4e-4 / 0.04;  // E A / L
      EXPECT_GT(vec(told.normal).z(), 0.999) << words << aside;
      EXPECT_NEAR(force, 1e-3 * k * 500 / (k + 500), 0.01 * force)
          << words << aside << " of the hand's spring and the column";
    }
}

/// Of a hollow that it is too wide for: its corners are in the ball before a sample of any face is, and the walls that it is between are
/// steeper than the ball.
TEST(TissueShapes, IsBorneByTheRimOfAHollowNarrowerThanItself) {
  Recipe recipe = palpated_by("shape = \"point\"\nradius_mm = 10");
  recipe.shape = Recipe::box(30, 30, 20);
  recipe.spacing_mm = 2.5;
  recipe.body += "\n[[body.cavity]]\ncenter_mm = [0, 0, 10]\nradius_mm = 8";
  Session session(recipe);
  // Depth of the tip at which the ball meets the rim's nearest corners, 5 mm aside each way [m].
  const double met = 0.01 - std::sqrt(1e-4 - 5e-5);
  bool bore = false;
  for (std::uint64_t n = 1; n <= 500; ++n) {
    const auto path = [](double t) {
      return Vec3(0, 0, 0.012 - 0.007 * std::clamp((t - 0.05) / 0.3, 0.0, 1.0));
    };
    session.to(n, path);
    const double depth = 0.01 - path(1e-3 * static_cast<double>(n)).z(), force = session.borne().z();
    if (depth < met) {
      ASSERT_EQ(force, 0) << n;
    }
    if (depth > met + 1e-3) {
      ASSERT_GT(force, 0) << "from a millimetre on: " << n;
      bore = true;
    }
  }
  EXPECT_TRUE(bore);
  EXPECT_GT(session.borne().z(), 0.05);
}

/// However flat the tissue is: a wedge without friction is pushed aside, or it would move tissue aside for nothing.
TEST(TissueShapes, IsPushedAsideWhereItsFaceIsTilted) {
  for (const double angle : {0.0, 10.0}) {
    Session session(palpated_by("shape = \"box\"\nsize_mm = [24, 24, 10]\ntheta_deg = [0, " +
                                std::to_string(-angle) + ", 0]"));
    const double slope = std::tan(angle * M_PI / 180);
    const auto slides = [&](double t) {  // the tip is in the middle of the face, its edge is lower
      const double aside = 2e-3 * std::clamp((t - 0.4) / 0.2, 0.0, 1.0);
      return Vec3(palpation(std::min(t, 0.15)) + Vec3(aside, 0, 0.012 * slope));
    };
    double given = 0;  // by the hand [J]
    Vec3 before = Vec3::Zero();
    for (std::uint64_t n = 1; n <= 700; ++n) {
      session.to(n, slides);
      const double t = 1e-3 * static_cast<double>(n);
      given -= 0.5 * (before + session.borne()).dot(slides(t) - slides(t - 1e-3));
      before = session.borne();
      if (n != 400) continue;
      const double aside = before.head<2>().norm() / before.z();
      EXPECT_GE(aside, 0.4 * slope) << angle;
      EXPECT_LE(aside, 1.1 * slope + 2e-3) << angle;
    }
    EXPECT_GT(before.z(), 0.2);
    const double spring = 0.5 / 500 * before.squaredNorm();
    EXPECT_GE(given - spring, 0.97 * session.world.tool(0).book().tissue_work())
        << angle << " is what tissue got";
  }
}

}  // namespace
}  // namespace palpate::physics::test
