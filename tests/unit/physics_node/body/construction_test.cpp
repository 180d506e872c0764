// Walls of layers, cavities, images on fcc, handles and turned bodies: what is built from what a scene says.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/record/png_file.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "physics_node/body/trim.h"
#include "physics_node/step/body_model.h"
#include "physics_node/world.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using palpate::test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;

Recipe recipe_of(const std::string& shape, double spacing_mm, const std::string& lattice = "fcc") {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = shape;
  recipe.spacing_mm = spacing_mm;
  return recipe;
}

std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.complaints().size() == 1 ? error.complaints()[0] : "several";
  }
  return "none";
}

std::string tube(const std::string& wall) {
  return "shape = \"tube\"\nouter_radius_mm = 10\nlength_mm = 24\n" + wall;
}

double rho(const Vec3& p) { return std::hypot(p.x(), p.y()); }

TEST(WallLayers, AreStepsBetweenNeighboursFromTheOutside) {
  const Body solid = body_of(recipe_of(tube(""), 2));
  std::size_t before = 0;
  for (int layers = 1; layers <= 4; ++layers) {
    const Body body = body_of(recipe_of(tube(fmt::format("wall_layers = {}", layers)), 2));
    EXPECT_GT(body.lattice.masses.size(), before);
    before = body.lattice.masses.size();
    double innermost = 1;
    for (const Index cell : body.lattice.masses)
      innermost = std::min(innermost, rho(body.lattice.rest_position(cell)));
    // A layer reaches no further in than a step between neighbours, and at least half of one on the mean.
    EXPECT_GE(innermost, 0.010 - 0.002 * layers - 1e-9);
    EXPECT_LE(innermost, 0.010 - 0.001 * (layers - 1));
    // What the wall lacks is all further in.
    for (const Index cell : solid.lattice.masses)
      if (rho(solid.lattice.rest_position(cell)) > 0.010 - 1e-9 - 0.5 * 0.002) {
        EXPECT_GE(body.lattice.mass_at(solid.lattice.grid_of(cell)), 0);
      }
  }
  EXPECT_THAT(complaint([] { body_of(recipe_of(tube("wall_layers = 40"), 2)); }),
              HasSubstr("is filled by its wall; make it wider"));
}

TEST(WallLayers, OfVoxelsAreCells) {
  for (const char* axis : {"x", "y", "z"}) {
    const auto cells = [&](const std::string& wall) {
      return make_cells(scene_of(recipe_of(fmt::format("{}\naxis = \"{}\"", tube(wall), axis), 2, "voxel"))
                            .bodies.front())
          .n_filled();
    };
    // 10 x 10 cells across, 12 along: 80 whose centres lie within the circle, in rings of 28, 20, 16, 12 and 4.
    EXPECT_EQ(cells(""), 12 * 80u);
    EXPECT_EQ(cells("wall_layers = 1"), 12 * 28u) << axis;
    EXPECT_GT(cells("wall_layers = 2"), cells("wall_layers = 1"));
    EXPECT_LT(cells("wall_layers = 2"), 12 * 80u);
  }
  EXPECT_THAT(
      complaint([] { make_cells(scene_of(recipe_of(tube("wall_layers = 9"), 2, "voxel")).bodies.front()); }),
      HasSubstr("is filled by its wall"));
}

TEST(Cavities, TakeMassesOfFccAndCellsOfVoxels) {
  Recipe recipe = recipe_of(Recipe::box(40, 40, 40), 5);
  recipe.body =
      "at_mm = [100, 0, 0]\n[[body.cavity]]\ncenter_mm = [100, 0, 0]\nradius_mm = 12\n"
      "[[body.cavity]]\nbox_min_mm = [70, -30, -30]\nbox_max_mm = [90, 0, 0]";
  for (const char* lattice : {"fcc", "voxel"}) {
    recipe.lattice = lattice;
    Recipe whole_recipe = recipe;
    whole_recipe.body = "at_mm = [100, 0, 0]";
    const Body body = body_of(recipe), whole = body_of(whole_recipe);
    const auto in_ball = [](const Vec3& p, double by) { return (p - Vec3(0.1, 0, 0)).norm() <= 0.012 + by; };
    const auto in_box = [](const Vec3& p, double by) {
      return p.x() <= 0.09 + by && p.y() <= by && p.z() <= by;
    };
    EXPECT_LT(body.lattice.n_masses(), whole.lattice.n_masses());
    const double cell =
        std::string(lattice) == "fcc" ? 1e-9 : 0.005;  // corners of cells reach into the cavity
    for (const Index mass : body.lattice.masses) {
      EXPECT_FALSE(in_ball(body.lattice.rest_position(mass), -cell));
      EXPECT_FALSE(in_box(body.lattice.rest_position(mass), -cell));
    }
    std::int64_t outside = 0;
    for (const Index mass : whole.lattice.masses) {
      const Vec3 p = whole.lattice.rest_position(mass);
      outside += !in_ball(p, cell) && !in_box(p, cell) ? 1 : 0;
    }
    EXPECT_LE(outside, body.lattice.n_masses()) << "nothing else is gone";
  }
  recipe.body = "[[body.cavity]]\ncenter_mm = [100, 0, 0]\nradius_mm = 12";
  for (const char* lattice : {"fcc", "voxel"}) {
    recipe.lattice = lattice;
    EXPECT_THAT(complaint([&] { body_of(recipe); }),
                HasSubstr("cavity 1 of body \"body\" takes nothing away; its place must reach"));
  }
}

TEST(Cavities, InAWallLeaveItsLayers) {
  Recipe recipe = recipe_of(tube("wall_layers = 2"), 2);
  const Body whole = body_of(recipe);
  recipe.body = "[[body.cavity]]\ncenter_mm = [10, 0, 0]\nradius_mm = 5";
  const Body body = body_of(recipe);
  std::int64_t taken = 0;
  for (const Index cell : whole.lattice.masses)
    taken += (whole.lattice.rest_position(cell) - Vec3(0.010, 0, 0)).norm() <= 0.005 ? 1 : 0;
  EXPECT_GT(taken, 10);
  EXPECT_EQ(body.lattice.n_masses(), whole.lattice.n_masses() - taken);
}

TEST(Trim, KeepsWhatHoldsTogether) {
  Lattice lattice = make_lattice(LatticeKind::fcc, {30, 5, 5}, Vec3::Zero(), Vec3::Ones());
  const auto put = [&](const Vec3i& grid) {
    lattice.mass_share[static_cast<std::size_t>(lattice.cell_of(grid))] = 1;
  };
  // Five masses round an octahedral site, a chain of two that hangs on one of them, and two masses far off.
  for (const Vec3i& grid : {Vec3i(1, 2, 1), Vec3i(3, 2, 1), Vec3i(2, 1, 1), Vec3i(2, 3, 1), Vec3i(2, 2, 2),
                            Vec3i(4, 3, 1), Vec3i(5, 4, 1), Vec3i(20, 2, 2), Vec3i(21, 3, 2)})
    put(grid);
  Lattice firm = lattice;
  drop_loose_masses(firm, 3);
  index_masses(firm);
  EXPECT_EQ(firm.n_masses(), 5);
  keep_largest_part(lattice);
  index_masses(lattice);
  EXPECT_EQ(lattice.n_masses(), 7);
}

TEST(Handle, IsTheTwoOutermostLayersOfItsFaces) {
  Recipe recipe =
      recipe_of("shape = \"knife\"\nlength_mm = 20\nheight_mm = 10\ntheta_deg = [30, 20, -70]", 2);
  recipe.body = "at_mm = [5, 6, 7]";
  const Body knife = body_of(recipe);
  EXPECT_EQ(knife.handle.size(), 11u + 10u) << "a row of either sheet";
  EXPECT_TRUE(std::is_sorted(knife.handle.begin(), knife.handle.end()));
  EXPECT_TRUE(knife.tip.isApprox(Vec3(5e-3, 6e-3, 7e-3)));
  for (const Index cell : knife.handle) EXPECT_GT(knife.inverse_mass[static_cast<std::size_t>(cell)], 0);
  EXPECT_EQ(knife.lattice.n_masses(), 11 * 6 + 10 * 5);
  EXPECT_TRUE(body_of(recipe_of(Recipe::box(20, 20, 20), 2)).handle.empty());
  Recipe box =
      recipe_of(Recipe::box(20, 20, 20) + "\ntheta_deg = [0, 0, 90]\nhandle = [\"+z\"]", 5 * std::sqrt(2.0));
  const Body turned = body_of(box);  // masses 5 mm apart across the axes
  EXPECT_EQ(turned.handle.size(), 13u + 12u);
  for (const Index cell : turned.handle)
    EXPECT_LE(turned.lattice.rest_position(cell).y(), -0.005 + 1e-9) << "its own z points to -y";
}

TEST(HeldMasses, AreNeverASingleRowWhichWouldBeAHinge) {
  Recipe recipe = recipe_of("shape = \"knife\"\nlength_mm = 20\nheight_mm = 10\nfixed = [\"+z\"]", 2);
  recipe.material = "density_kg_per_m3 = 8000\nmodulus_kPa = 20000\nviscosity_Pa_s = 50";
  EXPECT_EQ(body_of(recipe).n_held, 11 + 10) << "a row of either sheet, as for a handle";
  // It hangs in gravity from the side: on a hinge it would swing down by its height.
  recipe.gravity = "[0, 9.81, 0]";
  World world(scene_of(recipe));
  double farthest = 0;
  while (world.t() < 0.1) {  // a hinge would have turned by half a circle
    world.frame({});
    for (const Index cell : world.body(0).body().lattice.masses)
      farthest = std::max(farthest, world.body(0).displacement(cell).norm());
  }
  EXPECT_LT(farthest, 0.001);
  EXPECT_EQ(body_of(recipe_of(Recipe::box(20, 20, 20) + "\nfixed = [\"+z\"]", 5 * std::sqrt(2.0))).n_held, 13)
      << "one layer of a thick body holds it";
}

TEST(HeldMasses, OfATurnedBodyAreOnItsOwnFaces) {
  Recipe recipe =
      recipe_of(Recipe::box(20, 20, 20) + "\ntheta_deg = [0, 45, 0]\nfixed = [\"-x\"]", 5 * std::sqrt(2.0));
  const Body body = body_of(recipe);
  EXPECT_EQ(body.n_held, 13);
  const Vec3 x = rotation_of_angles({0, rad_from_deg(45), 0}).col(0);
  for (const Index cell : body.lattice.masses)
    EXPECT_EQ(body.inverse_mass[static_cast<std::size_t>(cell)] == 0,
              body.lattice.rest_position(cell).dot(x) < -0.009);
}

TEST(Floor, MeetsEveryMassOfATurnedBodyAtItsOwnHeight) {
  Recipe recipe =
      recipe_of(Recipe::box(20, 20, 20) + "\ntheta_deg = [10, 40, 70]\nvelocity_m_per_s = [0, 0, -1]", 2);
  const Scene scene = scene_of(recipe);
  const Body body = body_of(recipe);
  const double height = 0.0021, dt = 1e-9;
  std::int64_t below = 0;
  for (const Index cell : body.lattice.masses) below += body.lattice.rest_position(cell).z() < height ? 1 : 0;
  const auto moving = make_body_model(body, Precision::double_);
  moving->prepare_for(Disturbance::impulses);
  moving->remember_velocities();
  EXPECT_EQ(moving->bounce_off({Vec3::UnitZ(), height}, 1, dt).masses, below);
  EXPECT_EQ(moving->bounce_off({Vec3::UnitZ(), height}, 1, dt).masses, 0) << "they all rise now";
}

TEST(Spacing, MayDifferFromBodyToBody) {
  const Scene scene = parse_scene(R"([material.m]
density_kg_per_m3 = 1000
modulus_kPa = 20
[[body]]
name = "fine"
shape = "sphere"
radius_mm = 10
spacing_mm = 2
material = "m"
[[body]]
name = "coarse"
shape = "sphere"
radius_mm = 10
spacing_mm = 4
material = "m"
)",
                                  "s.toml");
  const Body fine = build_body(scene.bodies[0], scene.materials),
             coarse = build_body(scene.bodies[1], scene.materials);
  EXPECT_DOUBLE_EQ(fine.lattice.rest_length[0], 0.002);
  EXPECT_DOUBLE_EQ(coarse.lattice.rest_length[0], 0.004);
  EXPECT_NEAR(fine.law.mass / coarse.law.mass, 0.125, 1e-12) << "mass goes with the volume";
  EXPECT_NEAR(fine.law.k1[0] / coarse.law.k1[0], 0.5, 1e-12) << "k1 = E L / 0.943";
}

/// Slices whose grey is value(x, y, k), x to the right, y up.
std::vector<std::string> write_slices(const ScratchFolder& folder, int width, int height, int planes,
                                      const std::function<int(int, int, int)>& value) {
  std::vector<std::string> files;
  for (int k = 0; k < planes; ++k) {
    GreyPicture picture{width, height, 8, {}};
    for (int row = 0; row < height; ++row)
      for (int x = 0; x < width; ++x)
        picture.value.push_back(static_cast<std::uint16_t>(value(x, height - 1 - row, k)));
    files.push_back(folder / fmt::format("s{}.png", k));
    write_grey_png(picture, files.back());
  }
  return files;
}

BodySpec slices_body(std::vector<std::string> files, LatticeKind lattice) {
  BodySpec spec = volume_body("", 100, 255);
  auto& shape = std::get<VolumeShape>(spec.shape);
  shape.slices = SliceStack{std::move(files), Vec3(0.001, 0.002, 0.004)};
  spec.lattice = lattice;
  return spec;
}

TEST(Slices, StandInTheWorldAsOnTheScreen) {
  const ScratchFolder folder;
  // Bright where x >= 6 of 10 pixels, in the upper 2 of 4 rows, in the upper plane of 2.
  const auto files = write_slices(folder, 10, 4, 2,
                                  [](int x, int y, int k) { return x >= 6 && y >= 2 && k == 1 ? 200 : 7; });
  BodySpec spec = slices_body(files, LatticeKind::voxel);
  const Body voxels = build_body(spec, soft_material());
  EXPECT_EQ(voxels.cells->n_filled(), 4 * 2u);
  spec = slices_body(files, LatticeKind::fcc);
  spec.spacing = 0.0002;
  const Body fcc = build_body(spec, soft_material());
  for (const Body* body : {&voxels, &fcc})
    for (const Index cell : body->lattice.masses) {
      const Vec3 p = body->lattice.rest_position(cell);
      EXPECT_TRUE(p.x() > 0.001 - 1e-9 && p.y() > -1e-9 && p.z() > -1e-9) << p.transpose();
      EXPECT_TRUE(p.x() < 0.005 + 1e-9 && p.y() < 0.004 + 1e-9 && p.z() < 0.004 + 1e-9) << p.transpose();
    }
  const double volume = 0.004 * 0.004 * 0.004;
  EXPECT_NEAR(static_cast<double>(fcc.lattice.n_masses()) * volume_per_mass(fcc.lattice) / volume, 1, 0.1);
  EXPECT_EQ(fcc.intensity[static_cast<std::size_t>(fcc.lattice.masses[0])], 200);
}

TEST(Slices, KeepTheirLargestPartAndLoseTheirCavities) {
  const ScratchFolder folder;
  const auto files =
      write_slices(folder, 20, 8, 4, [](int x, int, int) { return x < 12 || x > 16 ? 200 : 7; });
  for (const auto lattice : {LatticeKind::voxel, LatticeKind::fcc}) {
    BodySpec spec = slices_body(files, lattice);
    if (lattice == LatticeKind::fcc) spec.spacing = 0.001;
    const auto all = build_body(spec, soft_material()).lattice.n_masses();
    std::get<VolumeShape>(spec.shape).largest_component = true;
    const Body body = build_body(spec, soft_material());
    EXPECT_LT(body.lattice.n_masses(), all);
    for (const Index cell : body.lattice.masses)
      EXPECT_LE(body.lattice.rest_position(cell).x(), 0.002 + 1e-9);
    // A cut through the larger part leaves the third.
    spec.cavities.push_back({BoxRegion{Vec3(-0.006, -1, -1), Vec3(-0.002, 1, 1)}, {}});
    const Body rest = build_body(spec, soft_material());
    EXPECT_LT(rest.lattice.n_masses(), body.lattice.n_masses());
    for (const Index cell : rest.lattice.masses) {
      const double x = rest.lattice.rest_position(cell).x();
      EXPECT_TRUE(x <= -0.006 + 1e-9 || x >= -0.002 - 1e-9);
    }
    spec.cavities[0].where = BallRegion{Vec3(1, 1, 1), 0.001};
    EXPECT_THAT(complaint([&] { build_body(spec, soft_material()); }),
                HasSubstr("cavity 1 of body \"image\" takes nothing"));
  }
}

TEST(Slices, KeepSomething) {
  const ScratchFolder folder;
  const auto files = write_slices(folder, 4, 4, 2, [](int, int, int) { return 7; });
  for (const auto lattice : {LatticeKind::voxel, LatticeKind::fcc}) {
    BodySpec spec = slices_body(files, lattice);
    if (lattice == LatticeKind::fcc) spec.spacing = 0.001;
    EXPECT_THAT(complaint([&] { build_body(spec, soft_material()); }),
                HasSubstr("keeps no voxel between 100 and 255; the image goes from 7 to 7"));
  }
}

}  // namespace
}  // namespace palpate::physics
