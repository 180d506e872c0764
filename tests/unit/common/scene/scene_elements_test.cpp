// Finite elements and what their materials may and may not be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using test::complaints_about;
using test::parsed;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

/// A box of finite elements of one material.
std::string elements(const std::string& material, const std::string& lattice = "voxel") {
  return "[material.m]\n" + material +
         "\n[[body]]\nname = \"b\"\nshape = \"box\"\nsize_mm = [9, 9, 9]\nspacing_mm = 1\n" + "lattice = \"" +
         lattice + "\"\nmaterial = \"m\"\nmodel = \"fem\"\n";
}

TEST(Elements, AreReadWithTheirMaterial) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n";
  const Scene scene = parsed(elements(tissue + "poisson_ratio = 0.3") + "hourglass = \"isotropic\"");
  EXPECT_EQ(scene.bodies[0].model, ElementModel::fem);
  EXPECT_EQ(scene.bodies[0].hourglass, HourglassKind::isotropic);
  EXPECT_EQ(scene.materials[0].poisson_ratio, 0.3);
  EXPECT_EQ(parsed(elements(tissue)).bodies[0].hourglass, HourglassKind::physical);
  EXPECT_EQ(parsed(elements(tissue)).materials[0].poisson_ratio, 0.45);
}

TEST(Elements, OfAModulusThatIsRefusedAreNotSaidToHaveNone) {
  for (const char* bad : {"-1", "0", "nan", "\"10\""})
    EXPECT_THAT(
        complaints_about(elements("density_kg_per_m3 = 1000\nmodulus_kPa = " + std::string(bad) + "\n")),
        ElementsAre(HasSubstr("modulus_kPa")))
        << bad;
}

TEST(Elements, MayFillTheCellsAtTheirBorder) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n",
                    filled = "border_cells = \"filled\"";
  EXPECT_EQ(parsed(elements(tissue)).bodies[0].border.cells, BorderCells::whole);
  EXPECT_EQ(parsed(elements(tissue) + filled).bodies[0].border.cells, BorderCells::filled);
  EXPECT_THAT(complaints_about(elements(tissue) + "border_cells = \"smooth\""),
              ElementsAre(HasSubstr("write \"whole\" or \"filled\"")));
  std::string springs = elements(tissue) + filled;
  springs.replace(springs.find("fem"), 3, "springs");
  EXPECT_THAT(complaints_about(springs), ElementsAre(HasSubstr("\"filled\" is of finite elements")));
  std::string tube = elements(tissue) + filled;
  const std::string box = "shape = \"box\"\nsize_mm = [9, 9, 9]";
  tube.replace(tube.find(box), box.size(),
               "shape = \"tube\"\nlength_mm = 9\nouter_radius_mm = 5\nwall_layers = 2");
  EXPECT_THAT(complaints_about(tube), ElementsAre(HasSubstr("beside wall_layers")));
}

TEST(Elements, MayBeginInBalance) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n";
  EXPECT_EQ(parsed(elements(tissue)).bodies[0].start, StartKind::rest);
  EXPECT_EQ(parsed(elements(tissue) + "start = \"balanced\"").bodies[0].start, StartKind::balanced);
  EXPECT_THAT(complaints_about(elements(tissue) + "start = \"hung\""),
              ElementsAre(HasSubstr("write \"rest\" or \"balanced\"")));
  EXPECT_THAT(complaints_about(elements(tissue + "relaxation = [[0.5, 1]]") + "start = \"balanced\""),
              ElementsAre(HasSubstr("relaxes and would sink on")));
  std::string springs = elements(tissue) + "start = \"balanced\"";
  springs.replace(springs.find("fem"), 3, "springs");
  EXPECT_THAT(complaints_about(springs), ElementsAre(HasSubstr("\"balanced\" is of finite elements")));
}

TEST(Elements, ReadWhatTheyForget) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n";
  const Scene scene = parsed(elements(tissue + "relaxation = [[0.3, 0.05], [0.2, 1]]"));
  ASSERT_EQ(scene.materials[0].relaxation.size(), 2U);
  EXPECT_EQ(scene.materials[0].relaxation[0].share, 0.3);
  EXPECT_EQ(scene.materials[0].relaxation[1].time, 1);
  const auto about = [&](const std::string& value) {
    return complaints_about(elements(tissue + "relaxation = " + value));
  };
  EXPECT_THAT(about("0.3"), ElementsAre(HasSubstr("[[0.3, 0.05], [0.2, 1]]")));
  EXPECT_THAT(about("[0.3, 0.05]"), ElementsAre(HasSubstr("[[0.3, 0.05], [0.2, 1]]")));
  EXPECT_THAT(about("[[0.3, 0.05, 1]]"), ElementsAre(HasSubstr("[[0.3, 0.05], [0.2, 1]]")));
  EXPECT_THAT(about("[[0, 1]]"), ElementsAre(HasSubstr("above 0 and below 1")));
  EXPECT_THAT(about("[[nan, 1]]"), ElementsAre(HasSubstr("relaxation")));
  EXPECT_THAT(about("[[0.5, 1e-4]]"), ElementsAre(HasSubstr("a time from 0.001 to 1e+06 s")));
  EXPECT_THAT(about("[[0.5, 1], [0.5, 2]]"), ElementsAre(HasSubstr("at most 0.95 of the modulus may fade")));
  EXPECT_THAT(about("[[0.1, 1], [0.1, 2], [0.1, 3], [0.1, 4], [0.1, 5]]"),
              ElementsAre(HasSubstr("at most 4")));
  EXPECT_THAT(complaints_about(elements(tissue + "relaxation = [[0.5, 1]]") + "hourglass = \"isotropic\""),
              ElementsAre(HasSubstr("write \"physical\"")));
  EXPECT_THAT(complaints_about("[physics]\nintegrator = \"backward_euler\"\n" +
                               elements(tissue + "relaxation = [[0.5, 1]]")),
              ElementsAre(HasSubstr("relaxes, which \"backward_euler\" does not follow")));
  EXPECT_THAT(complaints_about("[physics]\nintegrator = \"backward_euler\"\n" + elements(tissue)), IsEmpty());
  std::string springs = elements(tissue + "relaxation = [[0.5, 1]]");
  springs.replace(springs.find("fem"), 3, "springs");
  EXPECT_THAT(complaints_about(springs), ElementsAre(HasSubstr("write model = \"fem\", or leave it out")));
}

TEST(Elements, ReadTheirLaw) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n";
  EXPECT_EQ(parsed(elements(tissue)).materials[0].law, TissueLaw::neo_hookean);
  EXPECT_EQ(parsed(elements(tissue + "law = \"green\"")).materials[0].law, TissueLaw::green);
  EXPECT_THAT(complaints_about(elements(tissue + "law = \"hooke\"")),
              ElementsAre(HasSubstr("write \"neo_hookean\" or \"green\"")));
  EXPECT_THAT(complaints_about(elements(tissue + "law = \"green\"\nrelaxation = [[0.5, 1]]")),
              ElementsAre(HasSubstr("only \"neo_hookean\" does")));
  EXPECT_THAT(
      complaints_about("[physics]\nintegrator = \"backward_euler\"\n" + elements(tissue + "law = \"green\"")),
      ElementsAre(HasSubstr("has law = \"green\", which \"backward_euler\" does not follow")));
  std::string springs = elements(tissue + "law = \"green\"");
  springs.replace(springs.find("fem"), 3, "springs");
  EXPECT_THAT(complaints_about(springs),
              ElementsAre(HasSubstr("has a law, which only finite elements follow")));
}

TEST(Elements, ReadAModulusByIntensity) {
  const auto scanned = [](const std::string& table, const std::string& model = "fem") {
    return "[material.m]\ndensity_kg_per_m3 = 1000\nmodulus_by_intensity = " + table +
           "\n[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = \"volume\"\nfile = \"scan.h5\"\nkeep = [0, "
           "9]\nmodel = "
           "\"" +
           model + "\"\n";
  };
  const Scene scene = parsed(scanned("[[100, 20], [400, 2], [500, 3]]"));
  const MaterialSpec& material = scene.materials[0];
  ASSERT_EQ(material.modulus_by_intensity.size(), 3U);
  EXPECT_EQ(material.modulus_by_intensity[1].intensity, 400);
  EXPECT_DOUBLE_EQ(material.modulus_by_intensity[0].modulus, 20e3);
  EXPECT_THAT(material.modulus, Optional(2e3)) << "the least";
  const auto about = [&](const std::string& table) { return complaints_about(scanned(table)); };
  EXPECT_THAT(about("[[100, 20]]"), ElementsAre(HasSubstr("1 points of \"modulus_by_intensity\"")));
  EXPECT_THAT(about("[[100, 20], [100, 30]]"), ElementsAre(HasSubstr("above that of the point before")));
  EXPECT_THAT(about("[[100, 20], [90, 30]]"), ElementsAre(HasSubstr("above that of the point before")));
  EXPECT_THAT(about("[[nan, 20], [90, 30]]"), ElementsAre(HasSubstr("[[100, 2], [400, 20]]")));
  EXPECT_THAT(about("[[1, 20], [90, 0]]"), ElementsAre(HasSubstr("a modulus above 0 kPa")));
  EXPECT_THAT(about("[[1, inf], [90, 1]]"), ElementsAre(HasSubstr("[[100, 2], [400, 20]]")));
  EXPECT_THAT(about("[[1, 1e-3], [90, 1e5]]"), ElementsAre(HasSubstr("at most 1e+06 times")));
  EXPECT_THAT(complaints_about(scanned("[[1, 2], [3, 4]]", "springs")),
              ElementsAre(HasSubstr("has modulus_by_intensity, which only finite elements follow")));
  EXPECT_THAT(complaints_about(elements("density_kg_per_m3 = 1000\nmodulus_by_intensity = [[1, 2], [3, 4]]")),
              ElementsAre(HasSubstr("the body is no image; give modulus_kPa")));
}

TEST(Elements, RefuseWhatTheyCannotFollow) {
  const std::string tissue = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\n";
  const auto about = [](const std::string& text) { return complaints_about(text); };
  EXPECT_THAT(about(elements(tissue, "fcc")),
              ElementsAre(HasSubstr("needs cells; write lattice = \"voxel\"")));
  EXPECT_THAT(about(elements("mass_g = 1\nmodulus_kPa = 10")),
              ElementsAre(HasSubstr("[material.m] has no density_kg_per_m3")));
  EXPECT_THAT(about(elements("density_kg_per_m3 = 1000\nk1_N_per_m = 10")),
              ElementsAre(HasSubstr("[material.m] has no modulus_kPa")));
  EXPECT_THAT(about(elements(tissue + "yield_ratio = 1.1\nbreak_ratio = 1.2")),
              ElementsAre(HasSubstr("yields with k2_ratio = 1, which changes nothing")));
  const std::string plastic = tissue + "yield_ratio = 1.1\nk2_ratio = 0.1\n", clay = elements(plastic);
  EXPECT_THAT(about(clay), ElementsAre());
  EXPECT_THAT(about(elements(plastic + "break_ratio = 1.2")), ElementsAre());
  EXPECT_THAT(about(elements(plastic + "break_ratio = 1.05")),
              ElementsAre(HasSubstr("write a number above yield_ratio")));
  EXPECT_THAT(about(elements(plastic + "law = \"green\"")),
              ElementsAre(HasSubstr("yields beside law = \"green\"")));
  EXPECT_THAT(about(elements(plastic + "relaxation = [[0.3, 1]]")),
              ElementsAre(HasSubstr("yields and relaxes")));
  EXPECT_THAT(about(clay + "hourglass = \"isotropic\"\n"),
              ElementsAre(HasSubstr("[material.m] yields; write \"physical\"")));
  EXPECT_THAT(about(clay + "start = \"balanced\"\nfixed = [\"-z\"]\n"),
              ElementsAre(HasSubstr("[material.m] yields; the balance is found of what does not")));
  EXPECT_THAT(about(clay + "border_cells = \"filled\"\n"), ElementsAre());
  EXPECT_THAT(about(clay + "[physics]\nintegrator = \"backward_euler\"\n"),
              ElementsAre(HasSubstr("yields, which \"backward_euler\" does not follow")));
  EXPECT_THAT(about(elements(tissue + "break_ratio = 1.2\nlaw = \"green\"")),
              ElementsAre(HasSubstr("breaks beside law = \"green\"")));
  EXPECT_THAT(about(elements(tissue + "break_ratio = 1.2\nrelaxation = [[0.3, 1]]")),
              ElementsAre(HasSubstr("breaks and relaxes")));
  EXPECT_THAT(about(elements(tissue + "fracture_energy_J_per_m2 = 2")),
              ElementsAre(HasSubstr("\"fracture_energy_J_per_m2\" stands alone in [material.m]")));
  EXPECT_THAT(about(elements(tissue + "break_ratio = 1.2\nfracture_energy_J_per_m2 = 0")),
              ElementsAre(HasSubstr("write a number above 0")));
  const std::string brittle = elements(tissue + "break_ratio = 1.2\nfracture_energy_J_per_m2 = 2");
  EXPECT_THAT(about(brittle), ElementsAre());
  EXPECT_THAT(about(brittle + "border_cells = \"filled\"\n"),
              ElementsAre(HasSubstr("has cells that nobody sees")));
  const std::string springs =
      "[[body]]\nname = \"s\"\nshape = \"box\"\nsize_mm = [9, 9, 9]\nspacing_mm = 1\nmaterial = \"m\"\n";
  EXPECT_THAT(about(elements(tissue + "break_ratio = 1.2") + springs),
              ElementsAre(HasSubstr("\"break_ratio\" stands alone in [material.m]")));
  EXPECT_THAT(about(brittle + "[physics]\nintegrator = \"backward_euler\"\n"),
              ElementsAre(HasSubstr("breaks, which \"backward_euler\" does not follow")));
  EXPECT_THAT(about(elements(tissue + "viscosity_N_s_per_m = 1")),
              ElementsAre(HasSubstr("give viscosity_Pa_s")));
  EXPECT_THAT(about(elements(tissue + "drag_N_s_per_m = 1")), ElementsAre(HasSubstr("give viscosity_Pa_s")));
  EXPECT_THAT(about(elements(tissue + "viscosity_Pa_s = 1\ndamper = \"relative\"")),
              ElementsAre(HasSubstr("leave \"damper\" out")));
}

}  // namespace
}  // namespace palpate
