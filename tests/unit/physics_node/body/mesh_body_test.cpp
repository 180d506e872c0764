// A body from a mesh file: where it comes to lie, what it weighs, what of it is held and of which material.
#include "physics_node/body/mesh_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

using testing::HasSubstr;

std::string complaint(const Recipe& recipe) {
  try {
    body_of(recipe);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

Eigen::AlignedBox3d box_round(const Body& body) {
  Eigen::AlignedBox3d box;
  for (const Index node : body.nodes()) box.extend(body.rest_position(node));
  return box;
}

double mass_of(const Body& body) {
  double sum = 0;
  for (const Index node : body.nodes()) sum += node_mass(body, node);
  return sum;
}

TEST(MeshBody, LiesWithTheMiddleOfItsBoxAtItsPlace) {
  Recipe recipe = mesh_box({4, 3, 2}, 0.01);
  recipe.body = "at_mm = [5, 6, 7]";
  const Body body = body_of(recipe);
  const auto box = box_round(body);
  EXPECT_LT((box.center() - Vec3(0.005, 0.006, 0.007)).norm(), 1e-9);
  EXPECT_LT((box.sizes() - Vec3(0.04, 0.03, 0.02)).norm(), 1e-9);
  EXPECT_EQ(body.n_elements(), 4 * 3 * 2 * 6);
  EXPECT_NEAR(mass_of(body), 1000 * 0.04 * 0.03 * 0.02, 1e-9);
  EXPECT_EQ(body.n_held, 0);
  EXPECT_GT(body.spacing(), 0.01);
  EXPECT_LT(body.spacing(), 0.0142);
}

TEST(MeshBody, TurnsAboutThatMiddle) {
  Recipe recipe = mesh_box({4, 3, 2}, 0.01);
  recipe.body = "theta_deg = [90, 0, 0]\nfixed = [\"-x\"]";
  const Body body = body_of(recipe);
  EXPECT_LT((box_round(body).sizes() - Vec3(0.03, 0.04, 0.02)).norm(), 1e-9);
  EXPECT_EQ(body.n_held, 4 * 3) << "the nodes of a face of its own frame";
}

TEST(MeshBody, OfSecondOrderHasANodeMoreOnEachEdge) {
  const Body first = body_of(mesh_box({2, 2, 2}, 0.01)),
             second = body_of(mesh_box({2, 2, 2}, 0.01, "second_order"));
  EXPECT_EQ(first.n_nodes(), 27);
  EXPECT_EQ(second.n_nodes(), 125);
  EXPECT_NEAR(mass_of(first), mass_of(second), 1e-12);
  EXPECT_NEAR(second.spacing(), first.spacing() / 2, 1e-12);
}

TEST(MeshBody, IsHeldAtAFaceOrInABox) {
  Recipe recipe = mesh_box({4, 3, 2}, 0.01);
  recipe.body = "fixed = [\"-z\", { min_mm = [15, -100, -100], max_mm = [100, 100, 100] }]";
  const Body body = body_of(recipe);
  EXPECT_EQ(body.n_held, 5 * 4 + 4 * 2);
  std::size_t held = 0;
  for (const Index node : body.nodes()) {
    const auto n = static_cast<std::size_t>(node);
    EXPECT_EQ(body.inverse_mass[n] == 0, body.mesh->model.held[n]);
    held += body.mesh->model.held[n] ? 1U : 0U;
  }
  EXPECT_EQ(held, 28u);
}

TEST(MeshBody, IsNotHeldByAPointOfARoundFace) {
  Recipe recipe = mesh_box({2, 2, 2}, 0.01);
  recipe.body = "theta_deg = [0, 45, 0]\nfixed = [\"-z\"]";
  EXPECT_EQ(complaint(recipe), "") << "faces are of its own frame";
  TetMesh mesh;  // stands on its tip
  mesh.nodes = {{0, 0, 0}, {0.01, 0, 0.01}, {0, 0.01, 0.01}, {-0.01, -0.01, 0.01}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.region = {0};
  tidy(mesh);
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  recipe.body = "fixed = [\"-z\"]";
  EXPECT_THAT(complaint(recipe), HasSubstr("would hold a point or a line of its mesh"));
}

TEST(MeshBody, HasMaterialsByPlaceAndByGroup) {
  TetMesh mesh = make_tet_box({.cells = {4, 2, 2}, .edge = 0.01});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.region[t] = t < 24 ? 7 : 8;
  Recipe recipe;
  recipe.lattice = "";
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.world = "[material.hard]\ndensity_kg_per_m3 = 2000\nmodulus_kPa = 40\npoisson_ratio = 0.3\n";
  const double volume = 0.04 * 0.02 * 0.02;
  recipe.body = "regions = [{ material = \"hard\", group = 7 }]";
  const Body by_group = body_of(recipe);
  EXPECT_NEAR(mass_of(by_group), volume * (1000 + 1000 * 24 / 96.0), 1e-9);
  EXPECT_EQ(by_group.mesh->model.materials.size(), 2u);
  recipe.body = "regions = [{ material = \"hard\", box_min_mm = [0, -50, -50], box_max_mm = [50, 50, 50] }]";
  EXPECT_NEAR(mass_of(body_of(recipe)), volume * 1500, 1e-9);
  recipe.body = "regions = [{ material = \"hard\", group = 9 }]";
  EXPECT_THAT(complaint(recipe), HasSubstr("region 1 of body \"body\" holds no tetrahedron of it"));
  recipe.world += "viscosity_Pa_s = 1\n";
  recipe.body = "regions = [{ material = \"hard\", group = 7 }]";
  EXPECT_THAT(complaint(recipe), HasSubstr("viscosity over modulus"));
}

TEST(MeshBody, RefusesAMeshThatGoesThroughItself) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}, {0, 0, 0.02}, {0, 0, -0.01}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 1, 5}};
  mesh.region = {0, 0, 0};
  Recipe recipe = mesh_box({1, 1, 1}, 0.01);
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + mesh_file(mesh) + "\"";
  EXPECT_THAT(complaint(recipe), HasSubstr("1 faces in"));
}

TEST(MeshBody, JoinsWhatSharesATetrahedron) {
  const Body body = body_of(mesh_box({2, 2, 2}, 0.01));
  const Adjacency now = body.adjacency();
  for (const Index node : body.nodes()) {
    int n = 0;
    now.each_neighbour(node, [&](Index other) {
      ++n;
      EXPECT_TRUE(now.are_joined(node, other) && now.are_joined(other, node));
    });
    EXPECT_EQ(n, now.degree(node));
    EXPECT_FALSE(now.are_joined(node, node));
    EXPECT_FALSE(now.has_lost(node));
  }
}

}  // namespace
}  // namespace palpate::physics::test
