#include "bench/skips/skip_cases.h"

#include <algorithm>
#include <cmath>

#include "bench/problems/settings.h"
#include "common/record/volume.h"
#include "common/scene/body_spec.h"
#include "common/scene/element_kinds.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {
namespace {

/// About 20,000 masses of soft tissue, held below, two steps a frame.
Scene block() {
  Scene scene = empty_scene();
  MaterialSpec& tissue = scene.materials[0];
  tissue.mass.reset();
  tissue.k1.reset();
  tissue.density = 1000;
  tissue.modulus = 10e3;
  scene.bodies = {box_body(LatticeKind::fcc, Vec3(0.12, 0.12, 0.12), 0.005)};
  scene.bodies[0].fixed_faces[4] = true;
  scene.physics->step = 0.5e-3;
  scene.physics->threads = 1;
  return scene;
}

SkipCase damper() {
  SkipCase c{"damper", "elastic", "the same with axial dampers", block(), block()};
  c.full.materials[0].viscosity_bulk = 1;
  return c;
}

SkipCase yield() {
  SkipCase c{"yield and break", "elastic", "may yield but does not", block(), block()};
  c.full.materials[0].k2_ratio = 0.2;
  c.full.materials[0].yield_ratio = 1.5;
  c.full.materials[0].break_ratio = 3;
  return c;
}

SkipCase one_material() {
  SkipCase c{"constants by element", "one material", "half of it another material", block(), block()};
  MaterialSpec other = c.full.materials[0];
  other.name = "other";
  other.modulus = 5e3;
  c.full.materials.push_back(other);
  c.full.bodies[0].regions = {{"other", BoxRegion{Vec3(-1, -1, 0.06), Vec3(1, 1, 1)}, {}}};
  return c;
}

SkipCase sleep() {
  SkipCase c{"rows at rest", "at rest and may sleep", "at rest and may not", block(), block()};
  c.lean.physics->sleep = true;
  c.shaken = false;
  return c;
}

/// About 14,000 cells of soft tissue, held below, four steps a frame.
Scene solid_block() {
  Scene scene = block();
  scene.bodies = {box_body(LatticeKind::voxel, Vec3(0.06, 0.06, 0.06), 0.0025)};
  scene.bodies[0].fixed_faces[4] = true;
  scene.bodies[0].model = ElementModel::fem;
  scene.physics->step = 0.25e-3;
  return scene;
}

SkipCase solid_damper() {
  SkipCase c{"damper of elements", "elastic", "the same with viscosity", solid_block(), solid_block()};
  c.full.materials[0].viscosity_bulk = 0.2;
  return c;
}

SkipCase solid_hourglass() {
  SkipCase c{"bending terms of elements", "isotropic", "physical", solid_block(), solid_block()};
  c.lean.bodies[0].hourglass = HourglassKind::isotropic;
  return c;
}

SkipCase solid_one_material() {
  SkipCase c{"materials of elements", "one material", "half of it another material", solid_block(),
             solid_block()};
  MaterialSpec other = c.full.materials[0];
  other.name = "other";
  other.modulus = 5e3;
  c.full.materials.push_back(other);
  c.full.bodies[0].regions = {{"other", BoxRegion{Vec3(-1, -1, 0), Vec3(1, 1, 1)}, {}}};
  return c;
}

SkipCase solid_memory() {
  SkipCase c{"memory of elements", "lasting", "the same with one term of relaxation", solid_block(),
             solid_block()};
  c.full.materials[0].relaxation = {{.share = 0.5, .time = 0.1}};
  return c;
}

SkipCase solid_sleep() {
  SkipCase c{"elements at rest", "at rest and may sleep", "at rest and may not", solid_block(),
             solid_block()};
  c.lean.physics->sleep = true;
  c.shaken = false;
  return c;
}

/// Vessels along the three axes through the middle, and a ball of `radius` cells around it: bright; the rest dark.
Volume vessels(std::array<int, 3> size, int radius) {
  Volume volume;
  volume.size = volume.source_size = size;
  volume.spacing = Vec3::Constant(0.001);
  volume.transfer = {{0, {0, 0, 0, 0}}, {1000, {1, 1, 1, 1}}};
  volume.source = "made";
  volume.intensity.reserve(volume.n_cells());
  constexpr double thick = 8;  // [cells]
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        const Vec3 p(i - size[0] / 2, j - size[1] / 2, k - size[2] / 2);
        const double across =
            std::min({std::hypot(p.x(), p.y()), std::hypot(p.y(), p.z()), std::hypot(p.z(), p.x())});
        volume.intensity.push_back(across < thick || p.cwiseAbs().maxCoeff() <= radius ? 1000.F : 0.F);
      }
  return volume;
}

/// The cells within `radius` of the middle deform, in a volume of this size.
Scene volume_scene(const std::filesystem::path& file, std::array<int, 3> size, int radius) {
  write_volume(vessels(size, radius), file.string());
  Scene scene = block();
  VolumeShape shape;
  shape.file = file.string();
  shape.keep_min = 500;
  shape.keep_max = 2000;
  shape.deformable.all = false;
  shape.deformable.center_voxel = {size[0] / 2, size[1] / 2, size[2] / 2};
  shape.deformable.radius_voxels = radius;
  BodySpec& body = scene.bodies[0];
  body.shape = shape;
  body.spacing.reset();
  body.lattice = LatticeKind::voxel;
  body.fixed_faces = {};
  scene.physics->step = 0.1e-3;
  return scene;
}

SkipCase rigid_part(const std::filesystem::path& folder, ElementModel model) {
  constexpr int radius = 13;  // 27^3 cells
  SkipCase c{model == ElementModel::fem ? "rigid part beside elements" : "rigid part",
             "27 x 27 x 27 voxels of tissue alone", "the same in 336 x 336 x 140",
             volume_scene(folder / "small.h5", {29, 29, 29}, radius),
             volume_scene(folder / "large.h5", {336, 336, 140}, radius)};
  for (Scene* scene : {&c.lean, &c.full}) scene->bodies[0].model = model;
  c.frames = 50;
  return c;
}

}  // namespace

std::vector<SkipCase> skip_cases(const std::filesystem::path& folder) {
  return {damper(),
          yield(),
          one_material(),
          sleep(),
          rigid_part(folder, ElementModel::springs),
          solid_damper(),
          solid_hourglass(),
          solid_one_material(),
          solid_memory(),
          solid_sleep(),
          rigid_part(folder, ElementModel::fem)};
}

}  // namespace palpate::bench
