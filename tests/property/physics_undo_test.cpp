// The last stroke of a blade undone: tissue comes back to the bit, as joined as it was, whatever it is made of.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "physics_node/boundary/surface.h"
#include "tests/support/physics/blade_checks.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

const char* const soft =
    "density_kg_per_m3 = 1000\nmodulus_kPa = 200\nviscosity_Pa_s = 1\ncut_toughness_J_per_m2 = 190";
constexpr double low = -0.010, near = 0.0003, far = 0.0043;  // z of the tip; planes of two strokes [m]

Recipe with_scalpel(Recipe recipe) {
  recipe.physics += "\nframe_Hz = 1000";
  recipe.world +=
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\ndevice = \"hand\"\n"
      "stiffness_N_per_m = 1000\nedge_deg = 0\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 60, 0, 0], [1, 50, 0, 0]]\n";
  return recipe;
}

Recipe block(const std::string& lattice, const std::string& body, const std::string& material = "") {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = Recipe::box(18, 16, 10);
  recipe.spacing_mm = 2;
  recipe.material = soft + material;
  recipe.body = body + "\nfixed = [\"-y\", \"+y\"]";
  return with_scalpel(recipe);
}

Recipe mesh(const std::string& elements, const std::string& keys, const std::string& material = "") {
  Recipe recipe = mesh_box({6, 6, 4}, 0.003, "plain");
  const std::string plain = "elements = \"plain\"";
  recipe.shape.replace(recipe.shape.find(plain), plain.size(), elements);
  recipe.material = soft + material;
  recipe.body = keys + "\nfixed = [\"-y\", \"+y\"]";
  return with_scalpel(recipe);
}

/// Two blocks that do not touch, strands between them, and the first stroke of the blade goes through these alone.
Recipe bed() {
  Recipe recipe = block("voxel", "model = \"fem\"\nat_mm = [0, 9, 0]", "\npoisson_ratio = 0.45");
  recipe.world =
      "[contact]\nenabled = false\n"
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 2\nmaterial = \"m\"\n"
      "shape = \"box\"\nsize_mm = [18, 16, 10]\nat_mm = [0, -9.7, 0]\nfixed = [\"-y\"]\n"
      "[[connection]]\nname = \"bed\"\nfrom = \"other\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n"
      "cut_toughness_J_per_m2 = 190\n" +
      recipe.world;
  return recipe;
}

struct Tissue {
  const char* name;
  std::function<Recipe()> recipe;
  double again =
      0.03;  // how far the area of a stroke that is done again may be off; what breaks of itself is not cut
};
void PrintTo(const Tissue& tissue, std::ostream* out) { *out << tissue.name; }

/// What hangs together, and what has been opened.
struct Joined {
  explicit Joined(const LedBlade& cut)
      : area(cut.world.tool(0).book().cut_area()), copies(n_copies(cut.world.body(0).body())) {
    for (std::size_t b = 0; b < cut.world.n_bodies(); ++b) {
      breaks += cut.world.body(b).breaks();
      facets += make_surface(cut.world.body(b), std::nullopt, 0).facets.size();
      if (cut.world.fragments(b)) pieces += cut.world.fragments(b)->count();
    }
    for (std::size_t c = 0; c < cut.world.n_connections(); ++c)
      for (std::size_t s = 0; s < cut.world.connection(c).strands().size(); ++s)
        strands += 1 - cut.world.connection(c).left(s);
  }
  bool operator==(const Joined&) const = default;
  friend void PrintTo(const Joined& j, std::ostream* out) {
    *out << fmt::format("{} mm^2, {} copies, {} breaks, {} pieces, {} strands, {} facets", 1e6 * j.area,
                        j.copies, j.breaks, j.pieces, j.strands, j.facets);
  }

  double area;
  int copies;
  std::int64_t breaks = 0, pieces = 0;
  double strands = 0;  // that are cut
  std::size_t facets = 0;
};

/// Into the block and out of it again.
void stroke(LedBlade& cut, double y, double end = -0.003) {
  cut.along(Vec3(0.012, y, low), 1);
  cut.along(Vec3(end, y, low), 0.3);
  cut.along(Vec3(0.012, y, low), 1);
  for (int n = 0; n < 220; ++n) cut.to(cut.path.back());
}

class Undo : public testing::TestWithParam<Tissue> {
 protected:
  LedBlade cut{GetParam().recipe(), Vec3(0.012, near, low)};
};

TEST_P(Undo, JoinsWhatTheLastStrokeHasPartedAndLeavesTheOneBefore) {
  EXPECT_FALSE(cut.world.undo()) << "nothing has been cut";
  stroke(cut, near);
  const Joined once(cut);
  EXPECT_GT(static_cast<double>(once.breaks) + once.strands, 4);
  EXPECT_GT(once.area, 30e-6);
  stroke(cut, far);
  const Joined twice(cut);
  const double balance = cut.world.ledger().balance_error();
  EXPECT_GT(twice.breaks, once.breaks + 10);
  EXPECT_EQ(cut.world.report().strokes, 2);

  ASSERT_TRUE(cut.world.undo());
  EXPECT_EQ(Joined(cut), once);
  EXPECT_FALSE(cut.world.undo()) << "it knows one stroke";
  EXPECT_EQ(cut.world.report().undone, 1);

  stroke(cut, far);
  EXPECT_NEAR(cut.book().cut_area(), twice.area, GetParam().again * twice.area);
  EXPECT_LT(cut.world.ledger().balance_error(), 1e-2 + 2 * balance);
  EXPECT_EQ(cut.world.report().restored, 0);
}

TEST_P(Undo, BringsBackTheSameBitsHoweverLateItIsAsked) {
  stroke(cut, near);
  stroke(cut, far);
  for (int n = 0; n < 100; ++n) cut.to(cut.path.back());
  ASSERT_TRUE(cut.world.undo());

  LedBlade early(GetParam().recipe(), Vec3(0.012, near, low));
  for (std::size_t n = 2; early.world.report().strokes < 2; ++n) early.to(cut.path.at(n));
  ASSERT_TRUE(early.world.undo());
  EXPECT_EQ(cut.world.state_hash(), early.world.state_hash());
  for (int n = 0; n < 30; ++n)
    for (LedBlade* blade : {&cut, &early}) blade->world.frame({});
  EXPECT_EQ(cut.world.state_hash(), early.world.state_hash()) << "and goes on from them alike";
}

TEST_P(Undo, TakesForOneStrokeWhatTheBladeCutsUntilItHasLeft) {
  cut.along(Vec3(0.004, near, low), 0.2);
  for (int n = 0; n < 300; ++n) cut.to(cut.path.back());
  cut.along(Vec3(-0.003, near, low), 0.2);
  EXPECT_EQ(cut.world.report().strokes, 1);
  ASSERT_TRUE(cut.world.undo());
  EXPECT_EQ(Joined(cut), Joined(LedBlade(GetParam().recipe(), Vec3(0.012, near, low))));
}

TEST_P(Undo, KnowsNothingOfBeforeAReset) {
  stroke(cut, near);
  cut.world.reset();
  EXPECT_FALSE(cut.world.undo());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Undo,
    testing::Values(
        Tissue{"springs", [] { return block("fcc", ""); }},
        Tissue{"springs_that_yield",
               [] { return block("voxel", "", "\nk2_ratio = 0.3\nyield_ratio = 1.05\nbreak_ratio = 3"); },
               0.5},
        Tissue{"springs_of_verlet",
               [] {
                 Recipe recipe = block("voxel", "");
                 recipe.physics += "\nintegrator = \"velocity_verlet\"";
                 return recipe;
               }},
        Tissue{"cells", [] { return block("voxel", "model = \"fem\"", "\npoisson_ratio = 0.45"); }},
        Tissue{"tetrahedra",
               [] {
                 return mesh("elements = \"nodal_pressure\"", "model = \"fem\"", "\npoisson_ratio = 0.45");
               }},
        Tissue{"surface", [] { return mesh("thickness_mm = 2", "model = \"surface\""); }, 0.1},
        Tissue{"strands", bed}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace palpate::physics::test
