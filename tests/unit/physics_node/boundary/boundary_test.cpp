// The boundary of a body that breaks: closed after every break, the same as one made anew, and found by a tip.
#include "physics_node/boundary/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "physics_node/contact/stick_faces.h"
#include "physics_node/contact/tool_contact.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

using Corners = std::array<Index, 4>;

/// The same facet, whichever of its corners is named first.
Corners ordered(Corners c) {
  const auto end = c[2] == c[3] ? c.begin() + 3 : c.end();
  std::rotate(c.begin(), std::min_element(c.begin(), end), end);
  if (end != c.end()) c[3] = c[2];
  return c;
}

std::multiset<Corners> facets_of(const Boundary& boundary) {
  std::multiset<Corners> all;
  for (std::uint32_t f = 0; f < boundary.most_facets(); ++f)
    if (boundary.exists(f))
      all.insert(
          ordered({boundary.mass(f, 0), boundary.mass(f, 1), boundary.mass(f, 2), boundary.mass(f, 3)}));
  return all;
}

/// Edges that are not passed as often one way as the other: none of a surface that encloses something.
int open_edges(const std::multiset<Corners>& facets) {
  std::map<std::pair<Index, Index>, int> edges;
  for (const Corners& c : facets)
    for (std::size_t n = 0; n < 4; ++n) {
      const Index a = c[n], b = c[(n + 1) % 4];
      if (a != b) edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return static_cast<int>(
      std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }));
}

double volume_inside(const std::multiset<Corners>& facets, const Lattice& lattice) {
  double six = 0;
  for (const Corners& c : facets) {
    std::array<Vec3, 4> p;
    for (std::size_t n = 0; n < 4; ++n) p[n] = lattice.rest_position(c[n]);
    six += p[0].dot(p[1].cross(p[2])) + p[0].dot(p[2].cross(p[3]));
  }
  return six / 6;
}

class BoundaryFollows : public testing::TestWithParam<std::string> {
 protected:
  BoundaryFollows()
      : body_(make_body_model(body_of(fragile(GetParam(), Recipe::box(120, 120, 100))), Precision::double_)),
        boundary_(*body_, 0.04, true) {}

  /// Pulls masses a metre apart and lets the boundary see the step; then puts them back, so that only elements are gone.
  void tear(const std::vector<Index>& masses) {
    double far = 1;
    for (const Index mass : masses) body_->place(mass, Vec3(0, 0, far++), Vec3::Zero());
    body_->advance({.dt = 1e-9, .watch = true}, {});
    boundary_.follow();
    for (const Index mass : masses) body_->place(mass, Vec3::Zero(), Vec3::Zero());
  }
  void settle() {
    for (std::uint64_t before = 0; before != boundary_.revision();)
      before = boundary_.revision(), boundary_.update();
  }

  std::unique_ptr<BodyModel> body_;
  Boundary boundary_;
};
INSTANTIATE_TEST_SUITE_P(Lattices, BoundaryFollows, testing::Values("fcc", "voxel"));

TEST_P(BoundaryFollows, IsAsLoadedWhereNothingBreaks) {
  const auto facets = facets_of(boundary_);
  EXPECT_EQ(facets.size(), boundary_.surface().facets.size());
  EXPECT_EQ(open_edges(facets), 0);
  body_->advance({.dt = 1e-9, .watch = true}, {});
  boundary_.follow(), boundary_.update();  // the first state is a new one
  body_->advance({.dt = 1e-9, .watch = true}, {});
  const auto revision = boundary_.revision();
  boundary_.follow(), boundary_.update();
  EXPECT_EQ(boundary_.revision(), revision);
}

TEST_P(BoundaryFollows, IsClosedAndAsOneMadeAnewAfterEveryBreak) {
  const Lattice& lattice = body_->body().lattice;
  Dice dice(3);
  double volume = volume_inside(facets_of(boundary_), lattice);
  for (int round = 0; round < 12; ++round) {
    std::vector<Index> masses;  // anywhere, also beside each other and on the outside
    for (int n = 0; n < 1 + 4 * round; ++n)
      masses.push_back(
          lattice.masses[static_cast<std::size_t>(dice.between(0, 0.999999) * lattice.n_masses())]);
    tear(masses);
    settle();
    const auto facets = facets_of(boundary_);
    ASSERT_EQ(open_edges(facets), 0) << round;
    const double now = volume_inside(facets, lattice);
    EXPECT_LT(now, volume) << round;
    EXPECT_GT(now, 0);
    volume = now;
    Boundary anew(*body_, 0.04, true);
    for (int n = 0; n < 100; ++n) anew.update();
    ASSERT_EQ(facets_of(anew), facets) << round;
    EXPECT_EQ(boundary_.left_out(), 0u);
  }
  EXPECT_GT(boundary_.n_open(), 100u);
}

/// A closed form: what the tetrahedra at one mass deep inside hold is gone, and nothing else.
TEST_P(BoundaryFollows, LosesTheVolumeRoundOneMass) {
  const Lattice& lattice = body_->body().lattice;
  const double before = volume_inside(facets_of(boundary_), lattice);
  const Index mass = lattice.mass_at(GetParam() == "fcc" ? Vec3i(10, 10, 8) : Vec3i(6, 6, 5));
  ASSERT_GE(mass, 0);
  tear({mass});
  settle();
  // Voxels: an odd mass holds a corner of each of its eight cells, a sixth. fcc: the eight tetrahedra at a mass, of L^3 / (6 sqrt 2)
  // each; the six octahedra round it keep five masses each, half of which is filled: they lose L^3 sqrt(2) / 6 each.
  const double L = lattice.spacing();
  const double lost = GetParam() == "fcc" ? (8 / (6 * std::sqrt(2.0)) + 6 * std::sqrt(2.0) / 6) * L * L * L
                                          : 8 * lattice.step.prod() / 6;
  EXPECT_NEAR(before - volume_inside(facets_of(boundary_), lattice), lost, 1e-12 * before);
}

TEST_P(BoundaryFollows, IsAsLoadedAfterAReset) {
  const auto before = facets_of(boundary_);
  tear({body_->body().lattice.masses[100], body_->body().lattice.masses[500]});
  settle();
  ASSERT_NE(facets_of(boundary_), before);
  body_->reset();
  boundary_.follow();
  EXPECT_EQ(facets_of(boundary_), before);
  EXPECT_EQ(boundary_.n_open(), 0u);
}

/// Many breaks at once take several frames, and none is forgotten.
TEST_P(BoundaryFollows, SharesALotOfWorkAmongFrames) {
  const Lattice& lattice = body_->body().lattice;
  std::vector<Index> all;
  for (std::size_t n = 0; n < lattice.masses.size(); n += 3) all.push_back(lattice.masses[n]);
  tear(all);
  settle();
  EXPECT_EQ(open_edges(facets_of(boundary_)), 0);
}

/// The top of a block is torn away: what lies beneath is felt by a tip in the next frame, though it has not moved.
TEST_P(BoundaryFollows, IsFelt) {
  const Lattice& lattice = body_->body().lattice;
  double top = -1;
  for (const Index mass : lattice.masses) top = std::max(top, lattice.rest_position(mass).z());
  const Vec3 tip(0.001, 0.002, top);
  ToolContact contact(boundary_, *body_, 0.003);
  contact.look(tip, 0);
  ASSERT_TRUE(contact.plane_under(tip).found);
  EXPECT_NEAR(contact.plane_under(tip).point.z(), top, 1e-6);

  std::vector<Index> torn;
  for (const Index mass : lattice.masses) {
    const Vec3 p = lattice.rest_position(mass);
    if (p.z() > top - 0.011 && p.head<2>().norm() < 0.055) torn.push_back(mass);
  }
  tear(torn);
  double far = 1;  // away they go
  for (const Index mass : torn) body_->place(mass, Vec3(0, 0, far++), Vec3::Zero());
  boundary_.update();
  contact.look(tip, 0.004);
  const LocalPlane plane = contact.plane_under(tip);
  ASSERT_TRUE(plane.found);
  EXPECT_LT(plane.point.z(), top - 0.008);
  EXPECT_GT(plane.point.z(), top - 0.025);
  EXPECT_GT(plane.normal.z(), 0.95);
  contact.find_shares(plane.point);
  ASSERT_FALSE(contact.shares().empty());
  for (const MassShare& share : contact.shares())
    EXPECT_EQ(std::count(torn.begin(), torn.end(), share.cell), 0) << "a crumb bears nothing";
  PatchFacet facets[max_patch_facets];
  EXPECT_GT(contact.write_facets(plane.point, 0, facets, max_patch_facets, false), 4u);
}

/// What opens beside a stick is listed in the next frame, and what opens elsewhere makes nobody look.
TEST_P(BoundaryFollows, TellsAStickWhatHasOpenedBesideIt) {
  const Body& body = body_->body();
  const auto nearest = [&](const Vec3& p) {
    return *std::min_element(body.nodes().begin(), body.nodes().end(), [&](Index a, Index b) {
      return (body.rest_position(a) - p).norm() < (body.rest_position(b) - p).norm();
    });
  };
  const Stick stick{.A = Vec3(-0.005, 0, 0), .D = Vec3(0.01, 0, 0), .radius = 0.001};
  constexpr double reach = 0.002;
  StickFaces faces(boundary_, *body_, stick.radius);
  tear({nearest(Vec3(0.06, 0.06, 0.05))});  // the first state is a new one: all may have changed
  settle();
  faces.list(stick, reach);
  ASSERT_EQ(faces.size(), 0u) << "deep inside";
  EXPECT_FALSE(faces.has_changed(stick, reach));
  tear({nearest(Vec3(-0.06, -0.06, -0.05))});
  boundary_.update();
  EXPECT_FALSE(faces.has_changed(stick, reach));
  tear({nearest(Vec3::Zero())});
  boundary_.update();
  EXPECT_TRUE(faces.has_changed(stick, reach));
  faces.list(stick, reach);
  EXPECT_GT(faces.size(), 4u);
  EXPECT_FALSE(faces.has_changed(stick, reach));
}

/// One that cannot break holds nothing more and does nothing.
TEST(Boundary, CostsNothingWhereNothingBreaks) {
  Recipe recipe;
  recipe.shape = Recipe::box(60, 60, 60);
  const auto body = make_body_model(body_of(recipe), Precision::double_);
  Boundary boundary(*body, 0.04, true);
  EXPECT_EQ(boundary.most_facets(), boundary.surface().facets.size());
  boundary.follow(), boundary.update();
  EXPECT_EQ(boundary.revision(), 0u);
}

}  // namespace
}  // namespace palpate::physics
