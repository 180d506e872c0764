// Tetrahedra that fill the tissue of an image.
#include "deploy/import/mesh_of_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/error/error.h"
#include "common/math/units.h"
#include "physics_node/mesh/mesh_pinches.h"

namespace palpate {
namespace {

using testing::HasSubstr;

/// 60 x 50 x 30 cells of 1 x 1 x 2 mm: a large ball of 100 at a third of x, a small one of 100 at five sixths, one of 200 in the large one.
Volume three_balls() {
  Volume volume;
  volume.size = {60, 50, 30};
  volume.spacing = {1e-3, 1e-3, 2e-3};
  volume.intensity.assign(volume.n_cells(), 0.0F);
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d x(i + 0.5, j + 0.5, 2 * k + 1.0);
        float& cell = volume.intensity[static_cast<std::size_t>(i + 60 * (j + 50 * k))];
        if ((x - Eigen::Vector3d(20, 25, 30)).norm() < 16 || (x - Eigen::Vector3d(50, 25, 30)).norm() < 7)
          cell = 100;
        if ((x - Eigen::Vector3d(20, 25, 30)).norm() < 8) cell = 200;
      }
  return volume;
}

Vec3 middle_of(const physics::TetMesh& mesh) { return box_of(mesh).center(); }

TEST(MeshOfImage, IsAsLargeAsTheTissueAndWhereItIs) {
  const ImageMesh made =
      mesh_of_image(three_balls(), {.keep_min = 100, .keep_max = 255, .edge = 5e-3}, "scan");
  EXPECT_EQ(made.pieces, 2U);
  EXPECT_NEAR(made.tissue, 4.0 / 3 * 3.14159 * (16 * 16 * 16 + 7 * 7 * 7) * 1e-9, 0.02 * made.tissue);
  EXPECT_NEAR(made.filled, made.tissue, 2e-3 * made.tissue);
  EXPECT_GT(deg_from_rad(made.angles.least), 12);
  EXPECT_TRUE(pinches_of(made.mesh, outer_faces(made.mesh)).none());
  const ImageMesh one =
      mesh_of_image(three_balls(), {.keep_min = 100, .keep_max = 255, .edge = 5e-3, .largest = true}, "scan");
  EXPECT_EQ(one.pieces, 1U);
  EXPECT_LT((middle_of(one.mesh) - Vec3(0.020, 0.025, 0.030)).norm(), 5e-4);
}

TEST(MeshOfImage, LeavesOutWhatIsNotKept) {
  const ImageMesh shell =
      mesh_of_image(three_balls(), {.keep_min = 50, .keep_max = 150, .edge = 4e-3, .largest = true}, "scan");
  const ImageMesh core =
      mesh_of_image(three_balls(), {.keep_min = 200, .keep_max = 200, .edge = 4e-3}, "scan");
  EXPECT_NEAR(shell.filled + core.filled, 4.0 / 3 * 3.14159 * 16 * 16 * 16 * 1e-9, 0.02 * shell.filled);
}

/// A core of 8 mm in a ball of 16.
TEST(MeshOfImage, MakesTissuesRegionsThatShareNodes) {
  const ImageMesh made = mesh_of_image(
      three_balls(), {.keep_min = 50, .keep_max = 150, .edge = 4e-3, .largest = true, .others = {{200, 200}}},
      "scan");
  ASSERT_EQ(made.regions.size(), 2U);
  EXPECT_EQ(made.pieces, 1U);
  EXPECT_NEAR(made.regions[0].filled, made.regions[0].tissue, 0.02 * made.regions[0].tissue);
  EXPECT_NEAR(made.regions[1].filled, made.regions[1].tissue, 0.01 * made.regions[1].tissue);
  EXPECT_NEAR(made.regions[0].filled + made.regions[1].filled, made.filled, 1e-3 * made.filled);
  EXPECT_EQ(outer_faces(made.mesh).of_more, 0U);
  EXPECT_GT(deg_from_rad(made.angles.least), 10);
  std::vector<int> has(made.mesh.nodes.size());
  for (std::size_t t = 0; t < made.mesh.tets.size(); ++t)
    for (const auto node : made.mesh.tets[t]) has[static_cast<std::size_t>(node)] |= 1 << made.mesh.region[t];
  double sum = 0;
  int n = 0;
  for (std::size_t node = 0; node < has.size(); ++node) {
    if (has[node] != 3) continue;
    const double off = (made.mesh.nodes[node] - Vec3(0.020, 0.025, 0.030)).norm() - 8e-3;
    EXPECT_LT(std::abs(off), 2e-3);  // a cell's longest side
    sum += off * off, ++n;
  }
  EXPECT_GT(n, 50);
  EXPECT_LT(std::sqrt(sum / n), 6e-4);
}

TEST(MeshOfImage, RefusesARegionThatMissesItsTissue) {
  Volume volume = three_balls();
  for (float& cell : volume.intensity) cell = std::min(cell, 100.0F);
  volume.intensity[20 + 60 * (25 + 50 * 15)] = 200;  // one cell of 2 mm3
  try {
    mesh_of_image(volume, {.keep_min = 50, .keep_max = 150, .edge = 5e-3, .others = {{200, 200}}}, "scan");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scan: tetrahedra of 5 mm are too coarse for the tissue of region 1: "
                                        "they fill 0 cm3 of its 0.002; write a smaller --tetrahedra-mm"));
  }
}

TEST(MeshOfImage, StandsAsABodyOfTheImageWouldWhereAxesAreLeftHanded) {
  Volume volume = three_balls();
  volume.orientation = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  const ImageMesh made =
      mesh_of_image(volume, {.keep_min = 100, .keep_max = 255, .edge = 5e-3, .largest = true}, "scan");
  EXPECT_LT((middle_of(made.mesh) - Vec3(0.040, 0.025, 0.030)).norm(), 5e-4);
}

/// A bone between two others that is thinner than the tetrahedra: there the surface would touch itself, or be lost.
TEST(MeshOfImage, SaysWhatCannotBeMeshed) {
  const auto complaint = [](double lowest, double highest, double edge) -> std::string {
    try {
      mesh_of_image(three_balls(), {.keep_min = lowest, .keep_max = highest, .edge = edge}, "scan");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint(1, 2, 5e-3), HasSubstr("scan: no cell has an intensity from 1 to 2"));
  EXPECT_THAT(complaint(100, 255, 0.2),
              HasSubstr("tetrahedra of 200 mm are too coarse for this tissue: they fill"));
  EXPECT_THAT(complaint(100, 255, 1e-5), HasSubstr("are too many; write --tetrahedra-mm"));
}

/// Tissue that is lost, or filled up, is no mesh of it.
TEST(MeshOfImage, RefusesWhatMissesTheTissue) {
  Volume plate = three_balls();
  for (int k = 0; k < 30; ++k)
    for (int n = 0; n < 60 * 50; ++n)
      plate.intensity[static_cast<std::size_t>(n + 3000 * k)] = k == 15 ? 100 : 0;
  EXPECT_THROW(mesh_of_image(plate, {.keep_min = 100, .keep_max = 255, .edge = 8e-3}, "scan"), InputError);
  Volume grains = three_balls();
  for (std::size_t n = 0; n < grains.intensity.size(); ++n)
    grains.intensity[n] = (n * 2654435761U >> 16) % 2 == 0 ? 100 : 0;
  EXPECT_THROW(mesh_of_image(grains, {.keep_min = 100, .keep_max = 255, .edge = 4e-3}, "scan"), InputError);
}

TEST(MeshOfImage, AsksBeforeItTakesMemory) {
  double points = 0;
  ImageMeshOptions options{.keep_min = 100, .keep_max = 255, .edge = 5e-3};
  options.before_lattice = [&](double n) { points = n; };
  mesh_of_image(three_balls(), options, "scan");
  EXPECT_GT(points, 1000);
  EXPECT_LT(points, 20000);
}

}  // namespace
}  // namespace palpate
