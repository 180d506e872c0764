// A mesh that a tool parts: what can be touched, seen and met of it, and what hangs together, is what its tetrahedra say after
// every cut, and all that others keep of it follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/boundary/boundary.h"
#include "physics_node/boundary/exposed_triangles.h"
#include "physics_node/boundary/filled_volumes.h"
#include "physics_node/collision/contact_body.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/fragments/measure_fragments.h"
#include "tests/support/physics/led_blade.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/parted_checks.h"

namespace palpate::physics::test {
namespace {

Recipe tough_box(const std::array<int, 3>& cells = {5, 4, 3}, double edge = 0.005) {
  Recipe recipe = mesh_box(cells, edge);
  recipe.material += "\ncut_toughness_J_per_m2 = 190";
  return recipe;
}

std::unique_ptr<BodyModel> model_to_part(const Recipe& recipe) {
  const Scene scene = scene_of(recipe);
  Body body = build_body(scene.bodies.at(0), scene.materials);
  make_ready_for_cuts(scene.bodies.at(0), scene.materials, body);
  return make_body_model(std::move(body), Precision::double_);
}

const TetNet& net_of(const BodyModel& body) { return *body.body().mesh->net; }

/// In an order of its own.
std::vector<EdgeGone> inner_faces(const TetNet& net, unsigned seed) {
  std::vector<EdgeGone> all;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f)
      if (net.beyond(t, f) > t) all.push_back({t, net.beyond(t, f)});
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  return all;
}

Faces exposed_faces(const TetNet& net) {
  Faces faces;
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f)
      if (net.is_exposed(t, f)) faces.insert(turned(net.face(t, f)));
  return faces;
}
/// Cut by cut, at random, until it is in crumbs.
class PartedMesh : public testing::Test {
 protected:
  template <class Look>
  void part(int cuts, const Look& look) {
    test::part(*moving, inner_faces(net_of(*moving), 3), cuts, {.dt = 1e-5}, look);
  }
  std::unique_ptr<BodyModel> moving = model_to_part(tough_box());
};

TEST_F(PartedMesh, IsTouchedSeenAndMetAtTheFacesThatItHas) {
  expect_known_by_its_faces(*moving, inner_faces(net_of(*moving), 3), 20, {.dt = 1e-5},
                            [&] { return exposed_faces(net_of(*moving)); });
}

TEST_F(PartedMesh, FillsWhatItFilled) {
  const FilledVolumes volumes(*moving);
  part(4, [&] { expect_filled(*moving, volumes, 0.025 * 0.020 * 0.015); });
}

/// Found from what splits alone, as from nothing; and each weighs what its tetrahedra do.
TEST_F(PartedMesh, HangsTogetherAsAFloodOverAllSays) {
  Fragments followed(*moving);
  int most = 1;
  part(60, [&] { most = std::max(most, expect_to_hang_together(*moving, followed)); });
  EXPECT_EQ(most, net_of(*moving).n_elements()) << "crumbs in the end";
}

/// Places and velocities of the guard's good state are known of copies that are younger than it.
TEST_F(PartedMesh, GoesBackToWhereItWasParted) {
  const std::vector<EdgeGone> faces = inner_faces(net_of(*moving), 5);
  expect_to_go_back(*moving, std::span(faces).first(400));
}

Recipe with_scalpel(Recipe recipe, double length_mm = 40) {
  recipe.physics = "frame_Hz = 1000";
  recipe.world +=
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = " + std::to_string(length_mm) +
      "\ndevice = \"hand\"\nstiffness_N_per_m = 1000\nedge_deg = 0\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 60, 0, 0], [1, 50, 0, 0]]\n";
  return recipe;
}

/// What the eye is told piece by piece is what a new eye is told at once.
TEST(PartedWorld, IsDrawnWhereItHasOpened) {
  Recipe recipe = with_scalpel(tough_box());
  recipe.material.replace(recipe.material.find("= 10\n"), 4, "= 200");
  recipe.body += "fixed = [\"-y\", \"+y\"]";
  LedBlade cut(recipe, Vec3(0.020, 0.0003, -0.020));
  Appearance followed(cut.world, std::nullopt);
  const SurfaceSinks nowhere{[](const BodySurface&) {}, [](const SurfaceChange&) {}};
  followed.write_surfaces(nowhere);
  const std::size_t before = followed.facets_visible();
  for (const double x : {0.005, 0.0, -0.005, -0.030}) {
    cut.along(Vec3(x, 0.0003, -0.020), 0.2);
    followed.poll();
    followed.write_surfaces(nowhere);
    EXPECT_EQ(followed.facets_visible(), exposed_faces(net_of(cut.world.body(0))).size());
  }
  EXPECT_GT(followed.facets_visible(), before);
  EXPECT_EQ(cut.world.fragments(0)->count(), 2);
}

/// Strands that end on what is cut stay on the tetrahedra that they end on, at the place where they did.
TEST(PartedWorld, KeepsItsStrandsWhereTheyEnd) {
  Recipe recipe = tough_box({6, 4, 4});
  recipe.body += "fixed = [\"-z\"]";
  recipe.material.replace(recipe.material.find("= 10\n"), 4, "= 200");
  recipe.world =
      "[contact]\nenabled = false\n[[body]]\nname = \"upper\"\nlattice = \"voxel\"\nmodel = "
      "\"fem\"\nspacing_mm = "
      "5\nmaterial = \"m\"\nshape = \"box\"\nsize_mm = [30, 20, 10]\nat_mm = [0, 0, 17]\n"
      "[[connection]]\nname = \"bed\"\nfrom = \"upper\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n"
      "cut_toughness_J_per_m2 = 0.01\n";
  LedBlade cut(with_scalpel(recipe), Vec3(0.030, 0.0003, -0.005));
  const Connection& bed = cut.world.connection(0);
  std::vector<Vec3> rest;
  const auto foot_at_rest = [&](const Strand& strand) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      sum += strand.share[c] * cut.world.body(0).body().rest_position(strand.foot[c]);
    return sum;
  };
  for (const Strand& strand : bed.strands()) rest.push_back(foot_at_rest(strand));
  const std::vector<Strand> loaded = bed.strands();
  cut.along(Vec3(-0.040, 0.0003, -0.005), 0.3);
  const TetNet& net = net_of(cut.world.body(0));
  ASSERT_GT(net.n_copies(), 5);
  int moved = 0;
  for (std::size_t s = 0; s < rest.size(); ++s) {
    const Strand& strand = bed.strands()[s];
    EXPECT_LT((foot_at_rest(strand) - rest[s]).norm(), 1e-15);
    moved += strand.foot != loaded[s].foot ? 1 : 0;
    bool on_one = false;
    net.each_corner(strand.foot[0], [&](Index tet, std::size_t) {
      const auto& of = net.corners(tet);
      on_one = on_one || (std::ranges::find(of, strand.foot[1]) != of.end() &&
                          std::ranges::find(of, strand.foot[2]) != of.end());
    });
    EXPECT_TRUE(on_one);
  }
  EXPECT_GT(moved, 0);
  cut.world.reset();
  for (std::size_t s = 0; s < rest.size(); ++s) EXPECT_EQ(bed.strands()[s].foot, loaded[s].foot);
}

}  // namespace
}  // namespace palpate::physics::test
