// A mesh as a body of a scene: what is read, and what it cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/scene_source.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class SceneMesh : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder / "organ.msh") << "not read here"; }

  std::string text(const std::string& body, const std::string& material = "",
                   const std::string& more = "") const {
    return "title = \"t\"\n[material.m]\ndensity_kg_per_m3 = 1000\n" +
           (material.find("modulus") == material.npos ? "modulus_kPa = 10\n" + material : material) +
           "\n[[body]]\nname = \"organ\"\nshape = \"mesh\"\nfile = \"organ.msh\"\nmaterial = \"m\"\n" + body +
           "\n" + more;
  }
  Scene parsed(const std::string& body) const { return parse_scene(text(body), folder / "test.toml"); }
  std::vector<std::string> complaints(const std::string& body, const std::string& material = "",
                                      const std::string& more = "") const {
    try {
      parse_scene(text(body, material, more), folder / "test.toml");
    } catch (const InputError& error) {
      return error.complaints();
    }
    return {};
  }
  /// The only one. @param line  of the scene, where it must stand
  std::string complaint(const std::string& body, const std::string& material = "",
                        const std::string& more = "") const {
    const auto all = complaints(body, material, more);
    EXPECT_EQ(all.size(), 1u) << testing::PrintToString(all);
    return all.empty() ? "" : all.front();
  }

  const test::ScratchFolder folder;
  const std::string mm = "unit = \"mm\"\n";
};

/// A mesh of palpate import is in metres, and says so.
TEST_F(SceneMesh, OfPalpateImportHasNoUnit) {
  std::ofstream(folder / "organ.h5") << "not read here";
  const auto scene = [&](const std::string& body) {
    std::string all = text(body);
    return all.replace(all.find("organ.msh"), 9, "organ.h5");
  };
  const Scene read = parse_scene(scene(""), folder / "test.toml");
  EXPECT_EQ(std::get<MeshShape>(read.bodies.front().shape).metres, 1);
  try {
    parse_scene(scene(mm), folder / "test.toml");
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a mesh of palpate import is in metres; leave \"unit\" out"));
  }
}

TEST_F(SceneMesh, IsOfFiniteElementsWithNodalPressure) {
  const Scene scene = parsed(mm);
  const BodySpec& body = scene.bodies.front();
  const auto& mesh = std::get<MeshShape>(body.shape);
  EXPECT_EQ(mesh.metres, 0.001);
  EXPECT_EQ(mesh.file, folder / "organ.msh");
  EXPECT_EQ(body.model, ElementModel::fem);
  EXPECT_EQ(body.tet_elements, TetElements::nodal_pressure);
  EXPECT_FALSE(body.spacing);
  EXPECT_EQ(std::get<MeshShape>(parsed("unit = \"cm\"\n").bodies.front().shape).metres, 0.01);
  EXPECT_EQ(std::get<MeshShape>(parsed("unit = \"m\"\n").bodies.front().shape).metres, 1);
  EXPECT_EQ(parsed(mm + "elements = \"second_order\"\n").bodies.front().tet_elements,
            TetElements::second_order);
}

TEST_F(SceneMesh, TakesGroupsOfItsFileAsRegions) {
  const Scene scene = parsed(mm + "regions = [{ material = \"m\", group = 3 }]");
  ASSERT_EQ(scene.bodies.front().regions.size(), 1u);
  EXPECT_EQ(std::get<GroupRegion>(scene.bodies.front().regions.front().where).group, 3);
}

TEST_F(SceneMesh, IsAmongTheFilesOfTheScene) {
  const Scene scene = parsed(mm);
  EXPECT_THAT(files_of(scene), testing::Contains(folder / "organ.msh"));
}

TEST_F(SceneMesh, SaysWhatItLacks) {
  EXPECT_THAT(complaint(""), HasSubstr("lacks \"unit\"; write what one unit of the file is"));
  EXPECT_THAT(complaint("unit = \"inch\""), HasSubstr(":11:8: \"unit\" in [[body]] \"organ\" is \"inch\""));
  std::filesystem::remove(folder / "organ.msh");
  EXPECT_THAT(complaint(mm), HasSubstr("there is no file " + (folder / "organ.msh")));
  EXPECT_THAT(complaint(mm), HasSubstr("palpate import --phantom lobe --out"));
}

TEST_F(SceneMesh, RefusesWhatIsOfOtherShapes) {
  for (const auto& [keys, why] : std::vector<std::pair<std::string, std::string>>{
           {"lattice = \"voxel\"", "a mesh has no lattice"},
           {"spacing_mm = 2", "a mesh brings its own spacing"},
           {"hourglass = \"physical\"", "\"hourglass\" is of cells"},
           {"border_cells = \"filled\"", "\"border_cells\" is of cells"},
           {"skin = \"smooth\"", "\"skin\" is of cells"},
           {"handle = [\"+z\"]", "a mesh cannot be led by a hand"},
           {"cavity = [{ center_mm = [0, 0, 0], radius_mm = 1 }]", "nothing can be cut out of a mesh"},
           {"model = \"springs\"", "a mesh is of finite elements"},
           {"regions = [{ material = \"m\", intensity = [0, 1] }]", "\"intensity\" needs an image"}})
    EXPECT_THAT(complaint(mm + keys), testing::AllOf(HasSubstr(why), HasSubstr("test.toml:12:"))) << keys;
}

TEST_F(SceneMesh, RefusesWhatTetrahedraDoNotFollow) {
  EXPECT_THAT(complaint(mm, "yield_ratio = 1.1\nk2_ratio = 0.1"),
              HasSubstr("is a mesh, but [material.m] yields, which tetrahedra do not follow"));
  EXPECT_THAT(complaint(mm, "break_ratio = 1.5"), HasSubstr("[material.m] breaks, which"));
  EXPECT_THAT(complaint(mm, "relaxation = [[0.3, 0.05]]"), HasSubstr("[material.m] relaxes, which"));
  EXPECT_THAT(complaint(mm, "law = \"green\""), HasSubstr("[material.m] has law = \"green\", which"));
  EXPECT_THAT(complaint(mm, "drag_N_s_per_m = 1"), HasSubstr("[material.m] has drag_N_s_per_m"));
  EXPECT_THAT(complaints(mm, "viscosity_Pa_s = 1\npoisson_ratio = 0.49"), IsEmpty());
  for (const auto* integrator : {"velocity_verlet", "backward_euler"})
    EXPECT_THAT(complaint(mm, "", std::string("[physics]\nintegrator = \"") + integrator + "\"\n"),
                HasSubstr("a mesh is stepped by \"symplectic_euler\" only"));
}

TEST_F(SceneMesh, MayBeASurfaceOfSprings) {
  const BodySpec body = parsed(mm + "model = \"surface\"\nthickness_mm = 2\n").bodies.front();
  EXPECT_EQ(body.model, ElementModel::surface);
  ASSERT_TRUE(body.membrane);
  EXPECT_EQ(body.membrane->thickness, 0.002);
  EXPECT_EQ(body.membrane->pressure, 0);
  EXPECT_EQ(body.membrane->content_modulus, 0);
  const BodySpec full =
      parsed(mm + "model = \"surface\"\nthickness_mm = 2\npressure_kPa = -1\ncontent_modulus_kPa = 50\n")
          .bodies.front();
  EXPECT_EQ(full.membrane->pressure, -1000);
  EXPECT_EQ(full.membrane->content_modulus, 50e3);
  EXPECT_FALSE(parsed(mm).bodies.front().membrane);
}

TEST_F(SceneMesh, SaysWhatASurfaceLacksAndDoesNotFollow) {
  const std::string surface = mm + "model = \"surface\"\nthickness_mm = 2\n";
  EXPECT_THAT(complaint(mm + "model = \"surface\"\n"), HasSubstr("lacks \"thickness_mm\""));
  EXPECT_THAT(complaint(mm + "thickness_mm = 2\n"),
              HasSubstr("\"thickness_mm\" is of a mesh with model = \"surface\"; leave it out"));
  EXPECT_THAT(complaint(surface + "elements = \"plain\""), HasSubstr("\"elements\" is of tetrahedra"));
  EXPECT_THAT(complaint(surface + "start = \"balanced\""), HasSubstr("leave \"start\" out of a surface"));
  EXPECT_THAT(complaint(surface + "regions = [{ material = \"m\", group = 3 }]"),
              HasSubstr("\"regions\" is of tetrahedra"));
  for (const auto& [keys, why] : std::vector<std::pair<std::string, std::string>>{
           {"yield_ratio = 1.1\nk2_ratio = 0.1\nbreak_ratio = 2", "yields or breaks"},
           {"viscosity_N_s_per_m = 1", "which is of one spring"},
           {"viscosity_Pa_s = 1\ndamper = \"drag\"", "another damper"},
           {"relaxation = [[0.3, 0.05]]", "relaxes"},
           {"law = \"green\"", "has a law"},
           {"poisson_ratio = 0.4", "springs in a plane have 1/3"},
           {"modulus_by_intensity = [[0, 1], [1, 2]]", "no modulus_kPa"}})
    EXPECT_THAT(complaint(surface, keys),
                HasSubstr("model = \"surface\" in [[body]] \"organ\", but [material.m]"))
        << keys << why;
  EXPECT_THAT(complaints(surface, "viscosity_Pa_s = 1\ndrag_N_s_per_m = 0.1"), IsEmpty());
}

TEST_F(SceneMesh, KeepsItsKeysToItself) {
  const std::string box =
      "title = \"t\"\n[material.m]\nmass_g = 1\nk1_N_per_m = 1\n[[body]]\nname = \"b\"\nshape = "
      "\"box\"\nsize_mm = [5, 5, 5]\nspacing_mm = 1\nmaterial = \"m\"\n";
  const auto of_box = [&](const std::string& key) -> std::string {
    try {
      parse_scene(box + key, "t.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(of_box("elements = \"plain\""), HasSubstr("\"elements\" is of a mesh; leave it out"));
  EXPECT_THAT(of_box("unit = \"mm\""), HasSubstr("unit"));
  EXPECT_THAT(of_box("regions = [{ material = \"m\", group = 1 }]"), HasSubstr("\"group\" is of a mesh"));
}

}  // namespace
}  // namespace palpate
