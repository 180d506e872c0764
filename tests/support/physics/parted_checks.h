#pragma once
// What every body keeps to that is parted cut by cut, at random, until it is in crumbs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "physics_node/boundary/boundary.h"
#include "physics_node/boundary/filled_volumes.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/collision/contact_body.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/fragments/measure_fragments.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics::test {

/// Steps, opens the next of some faces, and calls look(), `cuts` times.
template <class Look>
void part(BodyModel& moving, const std::vector<EdgeGone>& faces, int cuts, const ExplicitStep& step,
          const Look& look) {
  const auto of = static_cast<std::size_t>(cuts);
  for (std::size_t c = 0; c < of; ++c) {
    moving.advance(step, {});
    const std::size_t first = c * faces.size() / of, last = (c + 1) * faces.size() / of;
    moving.cut(std::span(faces).subspan(first, last - first));
    look();
  }
}

/// @param volume  [m^3]
inline void expect_filled(const BodyModel& moving, const FilledVolumes& volumes, double volume) {
  double sum = 0;
  for (const Index node : moving.body().nodes())
    volumes.each(node, [&](const std::array<Vec3, 4>& x) {
      sum += std::abs((x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]))) / 6;
    });
  EXPECT_NEAR(sum, volume, 1e-6 * sum);
}

/// Found from what splits alone, as from nothing; and each weighs what its elements do. @return pieces
inline int expect_to_hang_together(const BodyModel& moving, Fragments& followed) {
  followed.update(moving);
  const Fragments anew(moving);
  EXPECT_EQ(followed.count(), anew.count());
  std::map<Index, Index> names;
  double mass = 0, of_pieces = 0;
  moving.body().each_node([&](Index node) {
    EXPECT_EQ(names.try_emplace(followed.label(node), anew.label(node)).first->second, anew.label(node));
    mass += node_mass(moving.body(), node);
  });
  for (const FragmentMeasure& piece : measure_fragments(moving, followed)) {
    EXPECT_GT(piece.mass, 0);
    of_pieces += piece.mass;
  }
  EXPECT_NEAR(of_pieces, mass, 1e-12 * mass);
  return static_cast<int>(anew.count());
}

/// Places of the guard's good state are known of copies that are younger than it.
inline void expect_to_go_back(BodyModel& moving, std::span<const EdgeGone> faces) {
  const Body& body = moving.body();
  moving.place(body.nodes()[7], Vec3(0.001, 0, 0), Vec3(0.1, 0, 0));
  moving.save(true), moving.save(true);
  std::map<Index, Vec3> before;
  for (const Index node : body.nodes()) before[node] = moving.displacement(node);
  for (int n = 0; n < 5; ++n) moving.advance({.dt = 1e-5}, {});
  moving.cut(faces);
  int copies = 0;
  body.each_copy([&](Index) { ++copies; });
  ASSERT_GT(copies, 10);
  for (int n = 0; n < 5; ++n) moving.advance({.dt = 1e-5}, {});
  moving.restore();
  EXPECT_TRUE(moving.events().none());
  body.each_node([&](Index node) { EXPECT_EQ(moving.displacement(node), before[body.origin(node)]); });
}

/// So that its smallest is first.
inline std::array<Index, 3> turned(std::array<Index, 3> face) {
  std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  return face;
}
using Faces = std::multiset<std::array<Index, 3>>;

/// Triangles, as the eye, a tool and another body know them.
inline Faces faces_of(const Surface& surface) {
  Faces faces;
  for (const auto& f : surface.facets)
    faces.insert(turned({surface.cell[f[0]], surface.cell[f[1]], surface.cell[f[2]]}));
  return faces;
}
inline Faces faces_of(const Boundary& boundary) {
  Faces faces;
  for (std::uint32_t f = 0; f < boundary.most_facets(); ++f)
    if (boundary.exists(f))
      faces.insert(turned({boundary.mass(f, 0), boundary.mass(f, 1), boundary.mass(f, 2)}));
  return faces;
}
inline Faces faces_of(const ContactBody& contact) {
  Faces faces;
  for (const auto& k : contact.facets()->all()) {
    const auto& cell = contact.candidates().cell();
    if (k[0] != k[1]) faces.insert(turned({cell[k[0]], cell[k[1]], cell[k[2]]}));
  }
  return faces;
}

/// Until nothing waits any more.
inline void bring_up_to_date(Boundary& boundary) {
  boundary.follow();
  for (std::uint64_t before = ~boundary.revision(); before != boundary.revision();) {
    before = boundary.revision();
    boundary.update();
  }
}

/// A tool, another body and the eye know it by the faces that it has, after every cut and after a reset.
/// @param truth  of the body, those now
template <class Truth>
void expect_known_by_its_faces(BodyModel& moving, const std::vector<EdgeGone>& faces, int cuts,
                               const ExplicitStep& step, const Truth& truth) {
  Boundary boundary(moving, 0.02, true);
  ContactBody contact(moving, true, true);
  EXPECT_EQ(faces_of(boundary), truth());
  part(moving, faces, cuts, step, [&] {
    bring_up_to_date(boundary);
    contact.follow_breaks();
    ASSERT_EQ(faces_of(boundary), truth());
    ASSERT_EQ(faces_of(contact), truth());
    ASSERT_EQ(faces_of(make_surface(moving, std::nullopt, 0)), truth());
    ASSERT_EQ(boundary.left_out(), 0u);
    for (std::size_t n = 0; n < contact.candidates().size(); ++n)
      ASSERT_EQ(contact.candidates().inverse_mass(n),
                moving.body().inverse_mass[static_cast<std::size_t>(contact.candidates().cell()[n])]);
  });
  moving.reset();
  boundary.follow(), boundary.update();
  contact.follow_breaks();
  EXPECT_EQ(faces_of(boundary), truth());
  EXPECT_EQ(faces_of(contact), truth());
}

}  // namespace palpate::physics::test
