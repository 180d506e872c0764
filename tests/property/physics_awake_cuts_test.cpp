// A scalpel in an image of which only what is near to it is stepped: it cuts and is felt as in all of it, and the cut stays when its
// tissue rests again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "physics_node/fragments/fragments.h"
#include "physics_node/report/physics_summary.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/blade_checks.h"
#include "tests/support/physics/made_volume.h"

namespace palpate::physics::test {
namespace {

const Vec3 size(0.060, 0.060, 0.040);  // of the block, round the origin [m]
constexpr double deep = 0.010;         // of the edge below the upper face
constexpr double plane = 0.0003;       // of the blade: y
constexpr double toughness = 190;
constexpr double aside = 0.5 * 0.060 + 0.006;  // x of the tip before it goes in

class AwakeCuts : public testing::Test {
 protected:
  void SetUp() override { write_volume(block_volume({34, 34, 22}), folder_ / "block.h5"); }
  Recipe block(const std::string& deformable, int threads = 1) const {
    Recipe recipe;
    recipe.lattice = "";
    recipe.shape = "shape = \"volume\"\nmodel = \"fem\"\nkeep = [0, 1000]\nfile = \"" +
                   (folder_ / "block.h5") + "\"\ndeformable = " + deformable;
    recipe.material =
        "density_kg_per_m3 = 1000\nmodulus_kPa = 200\npoisson_ratio = 0.45\nviscosity_Pa_s = 2\n"
        "cut_toughness_J_per_m2 = 190";
    recipe.body = "fixed = [\"-z\"]";
    recipe.physics = fmt::format("frame_Hz = 1000\nthreads = {}", threads);
    recipe.precision = "double";
    recipe.world =
        "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
        "stiffness_N_per_m = 1000\nedge_deg = 0\n"
        "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 36, 0, 10], [1, 36, 0, 10]]\n";
    return recipe;
  }
  static constexpr const char* awake = "{ awake_mm = 12 }";

  palpate::test::ScratchFolder folder_;
};

Vec3 at(double x) { return {x, plane, 0.5 * size.z() - deep}; }

struct Cut : LedBlade {
  explicit Cut(const Recipe& recipe) : LedBlade(recipe, at(aside)) {}
  const BodyModel& body() { return world.body(0); }
  /// Beside it in the air, for so long.
  void rest(int frames) {
    along(at(aside), 0.2);
    for (int n = 0; n < frames; ++n) to(at(aside));
  }
};

TEST_F(AwakeCuts, AreFeltAndOpenAsInAllOfIt) {
  Cut all(block("\"all\"")), part(block(awake));
  for (Cut* cut : {&all, &part}) cut->along(at(0.022), 0.1);
  const LedBlade::Stroke of_all = all.stroke(at(0.010), 0.1), of_part = part.stroke(at(0.010), 0.1);
  EXPECT_NEAR(of_part.force, of_all.force, 0.02 * of_all.force);
  EXPECT_NEAR(of_part.force - of_part.viscous, toughness * deep, 0.06 * toughness * deep);
  EXPECT_NEAR(part.book().cut_area(), all.book().cut_area(), 0.02 * all.book().cut_area());
  EXPECT_LT(part.body().sleeping_fraction(), 0.95);
  EXPECT_GT(part.body().sleeping_fraction(), 0.5);
  EXPECT_EQ(part.world.report().restored, 0);
  const EnergyLedger ledger = part.world.ledger();
  EXPECT_NEAR(ledger.cut, toughness * part.book().cut_area(), 1e-9);
  EXPECT_LT(ledger.balance_error(), 1e-3);
}

/// What sleeps is where it rests: the copies too. And as nothing was put back, the slot is there.
TEST_F(AwakeCuts, StayOpenWhenTheirTissueRests) {
  Cut cut(block(awake));
  cut.along(at(0.010), 0.2);
  const double opened = cut.book().cut_area();
  cut.rest(800);
  EXPECT_EQ(cut.body().sleeping_fraction(), 1);
  EXPECT_GT(n_copies(cut.body().body()), 10);
  cut.body().body().each_node([&](Index node) {
    ASSERT_EQ(cut.body().displacement(node), Vec3(0, 0, 0));
    ASSERT_EQ(cut.body().velocity(node), Vec3(0, 0, 0));
  });
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-3);
  for (const Vec3& force : cut.along(at(0.020), 0.2))
    EXPECT_LT(force.norm(), 0.05) << "nothing is left to cut, under the tip neither";
  EXPECT_NEAR(cut.book().cut_area(), opened, 0.005 * opened);
  for (const Vec3& force : cut.along(at(0), 0.1)) EXPECT_LT(force.norm(), 3);
  EXPECT_NEAR(cut.book().cut_area(), opened + 0.010 * deep, 0.15 * opened) << "and it goes on from there";
  EXPECT_EQ(cut.world.report().restored, 0);
}

/// No part of a mass is lost where rim and cut meet, whoever is awake.
TEST_F(AwakeCuts, LoseNoMassAndKeepTheirBooksFromSideToSide) {
  Cut cut(block(awake));
  const double before = mass_of(cut.body().body());
  cut.along(at(-aside), 0.3);
  EXPECT_NEAR(mass_of(cut.body().body()), before, 1e-14 * before);
  const double area = size.x() * deep;
  EXPECT_NEAR(cut.book().cut_area(), area, 0.07 * area);
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-3);
  EXPECT_EQ(cut.world.report().restored, 0);
}

/// A bar that is cut through is two pieces, and all that tells of them knows.
TEST_F(AwakeCuts, MakeTwoPiecesOfABar) {
  std::filesystem::remove(folder_ / "block.h5");
  write_volume(block_volume({10, 34, 7}), folder_ / "block.h5");
  LedBlade cut(block(awake), Vec3(0.012, plane, -0.008));
  cut.along(Vec3(-0.016, plane, -0.008), 0.1);
  EXPECT_EQ(cut.world.fragments(0)->count(), 2);
  const auto summary = physics_summary(cut.world, nullptr, 1.0);
  EXPECT_EQ(summary["bodies"]["body"]["fragments"].get<int>(), 2);
  EXPECT_EQ(summary["guard"]["restored"].get<int>(), 0);
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-3);
}

TEST_F(AwakeCuts, AreTheSameOnAnyNumberOfThreadsAndAgainAfterAReset) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    Cut cut(block(awake, threads));
    const std::uint64_t whole = cut.world.state_hash();
    for (int n = 0; n < 2; ++n) {
      cut.along(at(0.010), 0.3);
      EXPECT_GT(n_copies(cut.body().body()), 10);
      hashes.push_back(cut.world.state_hash());
      cut.rest(700);
      hashes.push_back(cut.world.state_hash());
      cut.world.reset();
      EXPECT_EQ(n_copies(cut.body().body()), 0);
      EXPECT_EQ(cut.world.state_hash(), whole);
      cut.path.assign(2, at(aside));
    }
  }
  for (std::size_t n = 2; n < hashes.size(); n += 2) {
    EXPECT_EQ(hashes[n], hashes[0]) << n;
    EXPECT_EQ(hashes[n + 1], hashes[1]) << n;
  }
}

}  // namespace
}  // namespace palpate::physics::test
