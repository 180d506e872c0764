// Scissors in springs and finite elements: the handles bear toughness times thickness times how fast the blades' crossing
// goes on, the hand what friction on the blades leaves; open and closed they cut nothing.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/math/units.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double toughness = 190, plane = 0.0003;
const Vec3 tip(0, plane, -0.016);  // closed blades of 40 mm reach through the strip, open ones cross above it

/// A strip 10 mm thick across the mouth and 30 mm deep, held at its sides.
Recipe strip(const std::string& body, const std::string& keys) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(10, 16, 30);
  recipe.spacing_mm = 2;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 400\nviscosity_Pa_s = 5\ncut_toughness_J_per_m2 = 190";
  recipe.body = body + "\nfixed = [\"-y\", \"+y\"]";
  recipe.physics = "frame_Hz = 1000";
  recipe.world =
      "[[tool]]\nname = \"scissors\"\nshape = \"scissors\"\nlength_mm = 40\noffset_mm = 4\ndevice = "
      "\"hand\"\n"
      "stiffness_N_per_m = 1000\n" +
      keys + "\n[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 30], [1, 0, 0, 30]]\n";
  return recipe;
}

struct Snip {
  explicit Snip(const Recipe& recipe)
      : world(scene_of(recipe)), blades(world.scene().tools[0].scissors), path{tip, tip} {}
  /// A frame after which the hand is there. @return force on tissue
  Vec3 to(const Vec3& at, bool pressed) {
    path.push_back(at);
    std::optional<ToolState> hand = recorded_hand(
        [this](double t) { return path[static_cast<std::size_t>(std::llround(1e3 * t))]; }, path.size() - 1);
    hand->stiffness = 1000;
    hand->buttons = pressed ? 1 : 0;
    world.frame(std::span(&hand, 1));
    closed += pressed ? 1e-3 : 0;
    return -world.tool(0).borne();
  }
  void stay(double seconds, bool pressed) {
    for (int n = static_cast<int>(std::lround(1e3 * seconds)); n > 0; --n) to(path.back(), pressed);
  }
  /// Once its button has been pressed for so long.
  double crossing() const {
    return std::min(blades.closed_crossing(), blades.open_crossing() + closed * blades.speed());
  }
  const TouchBook& book() { return world.tool(0).book(); }
  double thickness() const {
    Eigen::AlignedBox3d box;
    for (const Index node : world.body(0).body().nodes())
      box.extend(world.body(0).body().rest_position(node));
    return box.sizes().x();
  }

  World world;
  ScissorsSpec blades;
  std::vector<Vec3> path;
  double closed = 0;  // for how long the button was pressed [s]
};

struct Tissue {
  const char *name, *body;
};

class Scissors : public testing::TestWithParam<Tissue> {
 protected:
  static Recipe tissue(const std::string& keys = "") {
    Recipe recipe = strip(GetParam().body, keys);
    if (std::string(GetParam().name) == "fcc") recipe.lattice = "fcc";
    if (std::string(GetParam().body).find("fem") != std::string::npos)
      recipe.material += "\npoisson_ratio = 0.45";
    return recipe;
  }
};

/// T = Gc h |dx / dtheta|, x = e / sin(theta / 2): what the handles do between two openings, by the angle.
TEST_P(Scissors, AskOfTheHandlesToughnessTimesThicknessTimesTheWayOfTheCrossing) {
  Snip snip(tissue());
  const double h = snip.thickness(), e = snip.blades.offset;
  snip.stay(0.10, true);
  for (int part = 0; part < 3; ++part) {
    const double from = snip.crossing(), work = snip.book().handle_work();
    snip.stay(0.08, true);
    const double to = snip.crossing();
    const double turned = 2 * (std::asin(e / from) - std::asin(e / to));
    EXPECT_NEAR((snip.book().handle_work() - work) / turned, toughness * h * (to - from) / turned,
                0.05 * toughness * h * (to - from) / turned);
  }
  snip.stay(0.2, true);
  // The most of it where the blades leave the strip, a millimetre before their tips.
  const double half = std::asin(e / (snip.blades.closed_crossing() - 0.001));
  const double most = toughness * h * e * std::cos(half) / (2 * std::pow(std::sin(half), 2));
  EXPECT_NEAR(snip.book().handle_torque(), most, 0.1 * most);
  EXPECT_NEAR(snip.book().cut_area(), h * 0.030, 0.08 * h * 0.030);
  EXPECT_NEAR(snip.book().handle_work(), toughness * snip.book().cut_area(),
              0.03 * toughness * snip.book().cut_area());
  EXPECT_LT(snip.world.ledger().balance_error(), 1e-3);
}

/// Friction mu holds tissue in a mouth that is open by less than 2 atan(mu).
TEST_P(Scissors, PushTissueOutByWhatFrictionOnTheBladesLeaves) {
  for (const double friction : {0.0, 0.2}) {
    Snip snip(tissue(fmt::format("friction = {}", friction)));
    const double full = toughness * snip.thickness();
    snip.stay(0.10, true);
    for (int part = 0; part < 4; ++part) {
      double sum = 0, left = 0;
      for (int n = 0; n < 60; ++n) {
        sum += -snip.to(tip, true).z() / 60;
        const double half = std::asin(snip.blades.offset / snip.crossing());
        left += std::max(0.0, 1 - friction / std::tan(half)) / 60;
      }
      EXPECT_NEAR(sum, left * full, 0.06 * full) << friction << " " << part;
    }
  }
}

TEST_P(Scissors, CutNothingWhileTheyAreOpenClosedOrOpening) {
  Snip snip(tissue());
  const auto lead = [&](const Vec3& end, bool pressed) {
    const Vec3 begin = snip.path.back();
    for (int n = 1; n <= 100; ++n) EXPECT_EQ(snip.to(begin + (end - begin) * n / 100, pressed), Vec3::Zero());
  };
  lead(tip + Vec3(0, 0, -0.02), false);
  lead(tip + Vec3(0, 0, 0.04), false);  // out of the strip
  snip.stay(0.6, true);
  EXPECT_EQ(snip.book().cut_area(), 0) << "closed in air";
  lead(tip, true);
  lead(tip + Vec3(0, 0, -0.01), true);
  snip.stay(0.6, false);
  EXPECT_EQ(snip.book().cut_area(), 0);
  EXPECT_EQ(snip.book().handle_torque(), 0);
}

/// However often the button is let go of for a moment, and also where the hand's spring gives way: they pay for all that
/// they have passed.
TEST_P(Scissors, PayForAllThatTheyHavePassed) {
  for (const bool in_pulses : {false, true}) {
    Snip snip(tissue("friction = 0"));
    const double h = snip.thickness();
    for (int n = 0; n < (in_pulses ? 900 : 600); ++n) snip.to(tip, !in_pulses || n % 60 < 52);
    EXPECT_NEAR(snip.book().cut_area(), h * 0.030, 0.08 * h * 0.030) << in_pulses;
    if (in_pulses) continue;
    EXPECT_NEAR(snip.book().handle_work(), toughness * snip.book().cut_area(),
                0.04 * toughness * snip.book().cut_area());
    const double opened = snip.book().cut_area(), work = snip.book().handle_work();
    snip.stay(0.6, false), snip.stay(0.6, true);
    EXPECT_NEAR(snip.book().cut_area(), opened, 0.02 * opened) << "in its own slot";
    EXPECT_NEAR(snip.book().handle_work(), work, 0.03 * work);
  }
}

/// What hand and handles do is what the cut takes, whichever of them leads the blades on.
TEST_P(Scissors, AreNoScalpelThatNobodyPaysFor) {
  Snip snip(tissue("close_s = 20"));
  const Vec3 begin = tip + Vec3(0, 0, 0.010), end = tip - Vec3(0, 0, 0.020);
  snip.path = {begin, begin};
  double hand = 0;
  Vec3 force = Vec3::Zero();
  for (int n = 1; n <= 600; ++n) {
    force = snip.to(begin + (end - begin) * n / 600, true);
    hand += force.dot(end - begin) / 600;
  }
  hand -= 0.5 * force.squaredNorm() / 1000;  // what its spring holds
  const double cut = toughness * snip.book().cut_area();
  EXPECT_GT(cut, 0.5 * toughness * 0.010 * 0.030);
  EXPECT_GT(hand, 0.5 * cut);
  EXPECT_NEAR(hand + snip.book().handle_work(), cut, 0.08 * cut);
}

TEST_P(Scissors, LoseNothingAndAreTheSameOnAnyNumberOfThreadsAndAfterAReset) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Recipe recipe = tissue();
    recipe.physics += fmt::format("\nthreads = {}", threads);
    Snip snip(recipe);
    const auto mass = [&] {
      double sum = 0;
      for (const double inverse : snip.world.body(0).body().inverse_mass)
        sum += inverse > 0 ? 1 / inverse : 0;
      return sum;
    };
    const double before = mass();
    snip.stay(0.2, true);
    EXPECT_NEAR(mass(), before, 1e-12 * before);
    EXPECT_GT(snip.book().cut_area(), 0);
    hashes.push_back(snip.world.state_hash());
    if (threads > 1) continue;
    snip.world.reset();
    snip.path = {tip, tip};
    snip.stay(0.2, true);
    hashes.push_back(snip.world.state_hash());
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

INSTANTIATE_TEST_SUITE_P(Tissues, Scissors,
                         testing::Values(Tissue{"springs", "model = \"springs\""},
                                         Tissue{"fcc", "model = \"springs\""},
                                         Tissue{"elements", "model = \"fem\""}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace palpate::physics::test
