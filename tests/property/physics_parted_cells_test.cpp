// Cells of finite elements that a tool parts: what can be touched and seen of them, and what hangs together, is what they say after
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
#include "physics_node/boundary/boundary.h"
#include "physics_node/boundary/filled_volumes.h"
#include "physics_node/collision/contact_body.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/fragments/measure_fragments.h"
#include "tests/support/physics/blade_checks.h"
#include "tests/support/physics/parted_checks.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double volume = 0.030 * 0.020 * 0.015;  // [m^3]

std::unique_ptr<BodyModel> model_to_part() {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(30, 20, 15);
  recipe.spacing_mm = 5;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 1\n"
      "cut_toughness_J_per_m2 = 190";
  recipe.body = "model = \"fem\"";
  const Scene scene = scene_of(recipe);
  Body body = build_body(scene.bodies.at(0), scene.materials);
  make_ready_for_cuts(scene.bodies.at(0), scene.materials, body);
  return make_body_model(std::move(body), Precision::double_);
}

const CellNet& net_of(const BodyModel& body) { return *body.body().cell_net(); }

/// In an order of its own.
std::vector<EdgeGone> inner_faces(const CellNet& net, unsigned seed) {
  std::vector<EdgeGone> all;
  for (const Index cell : net.cells())
    for (std::size_t f = 1; f < CellNet::n_faces; f += 2)
      if (const Index other = net.beyond(cell, f); other != CellNet::none) all.push_back({cell, other, {}});
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  return all;
}

/// Lists so that its smallest is first.
std::array<Index, 4> turned(std::array<Index, 4> face) {
  std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  return face;
}
using Faces = std::multiset<std::array<Index, 4>>;

Faces exposed_faces(const CellNet& net) {
  Faces faces;
  for (const Index cell : net.cells())
    for (std::size_t f = 0; f < CellNet::n_faces; ++f)
      if (net.is_exposed(cell, f)) faces.insert(turned(net.face(cell, f)));
  return faces;
}
Faces faces_of(const Surface& surface) {
  Faces faces;
  for (const auto& f : surface.facets)
    faces.insert(turned({surface.cell[f[0]], surface.cell[f[1]], surface.cell[f[2]], surface.cell[f[3]]}));
  return faces;
}
Faces faces_of(const Boundary& boundary) {
  Faces faces;
  for (std::uint32_t f = 0; f < boundary.most_facets(); ++f)
    if (boundary.exists(f))
      faces.insert(
          turned({boundary.mass(f, 0), boundary.mass(f, 1), boundary.mass(f, 2), boundary.mass(f, 3)}));
  return faces;
}

/// Cut by cut, at random, until it is in crumbs.
class PartedCellsOfABody : public testing::Test {
 protected:
  template <class Look>
  void part(int cuts, const Look& look) {
    test::part(*moving, inner_faces(net_of(*moving), 3), cuts,
               {.dt = 1e-5, .gravity = Vec3(0, 0, -9.81), .watch = true}, look);
  }
  std::unique_ptr<BodyModel> moving = model_to_part();
};

TEST_F(PartedCellsOfABody, AreTouchedAndSeenAtTheFacesThatTheyHave) {
  Boundary boundary(*moving, 0.02, true);
  ContactBody contact(*moving, true, true);
  EXPECT_EQ(faces_of(boundary), exposed_faces(net_of(*moving)));
  part(20, [&] {
    bring_up_to_date(boundary);
    contact.follow_breaks();
    const Faces truth = exposed_faces(net_of(*moving));
    ASSERT_EQ(faces_of(boundary), truth);
    ASSERT_EQ(faces_of(make_surface(*moving, std::nullopt, 0)), truth);
    ASSERT_EQ(boundary.left_out(), 0u);
    std::set<Index> met;
    for (std::size_t n = 0; n < contact.candidates().size(); ++n) {
      const Index node = contact.candidates().cell()[n];
      met.insert(node);
      ASSERT_EQ(contact.candidates().inverse_mass(n),
                moving->body().inverse_mass[static_cast<std::size_t>(node)]);
    }
    for (const auto& face : truth)
      for (const Index node : face) ASSERT_TRUE(met.contains(node));
  });
  moving->reset();
  boundary.follow(), boundary.update();
  contact.follow_breaks();
  EXPECT_EQ(faces_of(boundary), exposed_faces(net_of(*moving)));
}

TEST_F(PartedCellsOfABody, FillWhatTheyFilled) {
  const FilledVolumes volumes(*moving);
  part(4, [&] { expect_filled(*moving, volumes, volume); });
}

/// Found from what splits alone, as from nothing; and each weighs what its cells do.
TEST_F(PartedCellsOfABody, HangTogetherAsAFloodOverAllSays) {
  Fragments followed(*moving);
  int most = 1;
  part(60, [&] {
    most = std::max(most, expect_to_hang_together(*moving, followed));
    EXPECT_NEAR(mass_of(moving->body()), 1000 * volume, 1e-12 * 1000 * volume);
  });
  EXPECT_EQ(static_cast<std::size_t>(most), net_of(*moving).cells().size()) << "crumbs in the end";
}

/// It falls as it did, whatever is cut: no force comes from parting, and books close.
TEST_F(PartedCellsOfABody, FallAsOne) {
  part(40, [] {});
  const double fallen = 9.81 * 40 * 1e-5;
  moving->body().each_node([&](Index node) {
    EXPECT_NEAR(moving->velocity(node).z(), -fallen, 1e-9);
    EXPECT_NEAR(moving->velocity(node).head<2>().norm(), 0, 1e-9);
  });
  const Watch seen = moving->watch();
  const double mass = 1000 * volume;
  EXPECT_NEAR(seen.kinetic, 0.5 * mass * fallen * fallen, 1e-9 * seen.kinetic);
}

/// Places of the guard's good state are known of copies that are younger than it.
TEST_F(PartedCellsOfABody, GoBackToWhereTheyWereParted) {
  const std::vector<EdgeGone> faces = inner_faces(net_of(*moving), 5);
  expect_to_go_back(*moving, std::span(faces).first(100));
}

}  // namespace
}  // namespace palpate::physics::test
