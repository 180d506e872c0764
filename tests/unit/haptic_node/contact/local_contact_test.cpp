#include "haptic_node/contact/local_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptic_node/contact/facet_geometry.h"

namespace palpate::haptic {
namespace {

constexpr double K = 400;
constexpr double dt = 1e-3;

PatchFacet facet(const Array3& a, const Array3& b, const Array3& c, const Array3& normal) {
  PatchFacet f;
  f.corners = {a, b, c};
  f.point = a;
  f.normal = normal;
  f.stiffness = rigid_stiffness;
  return f;
}

void add_square(ContactPatch& patch, const Array3& a, const Array3& b, const Array3& c, const Array3& d,
                const Array3& normal) {
  patch.facets[patch.n_facets++] = facet(a, b, c, normal);
  patch.facets[patch.n_facets++] = facet(a, c, d, normal);
}

/// The solid x < 0, z < 0: a top that ends at the edge x = 0, and a side.
ContactPatch convex_edge() {
  ContactPatch patch;
  add_square(patch, {-0.05, -0.05, 0}, {0, -0.05, 0}, {0, 0.05, 0}, {-0.05, 0.05, 0}, {0, 0, 1});
  add_square(patch, {0, -0.05, 0}, {0, -0.05, -0.05}, {0, 0.05, -0.05}, {0, 0.05, 0}, {1, 0, 0});
  return patch;
}

/// A floor z = 0 for x < 0 and a wall x = 0 above it that faces -x.
ContactPatch concave_corner() {
  ContactPatch patch;
  add_square(patch, {-0.05, -0.05, 0}, {0, -0.05, 0}, {0, 0.05, 0}, {-0.05, 0.05, 0}, {0, 0, 1});
  add_square(patch, {0, -0.05, 0}, {0, 0.05, 0}, {0, 0.05, 0.05}, {0, -0.05, 0.05}, {-1, 0, 0});
  return patch;
}

/// Slowly from `from` to `to`; `each` sees every tick.
template <class Each>
void walk(LocalContact& contact, const Vec3& from, const Vec3& to, int ticks, Each&& each) {
  for (int i = 1; i <= ticks; ++i) {
    const Vec3 x = from + (to - from) * (static_cast<double>(i) / ticks);
    each(x, contact.tick(x, Vec3::Zero(), dt));
  }
}

TEST(ClosestOnTriangle, BeatsEveryPointOfAFineGrid) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> g;
  const auto any = [&] { return Vec3(g(random), g(random), g(random)); };
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = any(), b = any(), c = any(), p = 2 * any();
    const double found = (p - closest_on_triangle(p, a, b, c)).norm();
    double least = 1e9;
    for (int u = 0; u <= 60; ++u)
      for (int v = 0; u + v <= 60; ++v)
        least = std::min(least, (p - (a + u / 60.0 * (b - a) + v / 60.0 * (c - a))).norm());
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 0.15);
  }
}

TEST(ClosestOnTriangle, StandsATriangleWithoutArea) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  EXPECT_TRUE(closest_on_triangle({0.5, 1, 0}, a, b, c).allFinite());
  EXPECT_TRUE(closest_on_triangle({0.5, 1, 0}, a, a, a).isApprox(a));
}

TEST(LocalContact, IsNotFeltBesideAConvexEdge) {
  LocalContact contact(K, 0);
  contact.take(convex_edge(), dt);
  walk(contact, {0.02, 0, 0.01}, {0.005, 0, -0.02}, 500,
       [](const Vec3&, const ContactResult& felt) { ASSERT_EQ(felt.force.norm(), 0.0); });
}

TEST(LocalContact, DoesNotPullTowardTheSideOfAConvexEdge) {
  LocalContact contact(K, 0);
  contact.take(convex_edge(), dt);
  walk(contact, {-0.004, 0, 0.005}, {-0.004, 0, -0.006}, 500, [](const Vec3& x, const ContactResult& felt) {
    ASSERT_NEAR(felt.force.x(), 0, 1e-12);
    ASSERT_NEAR(felt.force.z(), K * std::max(0.0, -x.z()), 1e-6);
  });
}

TEST(LocalContact, LetsGoBeyondAConvexEdge) {
  LocalContact contact(K, 0);
  contact.take(convex_edge(), dt);
  walk(contact, {-0.01, 0, 0.001}, {-0.01, 0, -0.002}, 200, [](const Vec3&, const ContactResult&) {});
  walk(contact, {-0.01, 0, -0.002}, {0.01, 0, -0.002}, 400, [](const Vec3& x, const ContactResult& felt) {
    if (x.x() < -0.0005) {
      ASSERT_NEAR(felt.force.z(), K * 0.002, 1e-6);
    }
    if (x.x() > 0.002) {
      ASSERT_EQ(felt.force.norm(), 0.0) << x.x();
    }
  });
}

TEST(LocalContact, FeelsBothSidesOfAConcaveCorner) {
  LocalContact contact(K, 0);
  contact.take(concave_corner(), dt);
  ContactResult last;
  walk(contact, {-0.01, 0, 0.001}, {-0.01, 0, -0.001}, 200, [](const Vec3&, const ContactResult&) {});
  walk(contact, {-0.01, 0, -0.001}, {0.002, 0, -0.001}, 400,
       [&](const Vec3&, const ContactResult& felt) { last = felt; });
  EXPECT_EQ(last.n_planes, 2u);
  EXPECT_NEAR(last.force.x(), -K * 0.002, 1e-6);
  EXPECT_NEAR(last.force.z(), K * 0.001, 1e-6);
  EXPECT_LT((last.proxy - Vec3(0, 0, 0)).norm(), 1e-6);
}

TEST(LocalContact, BeginsEveryContactWithoutForce) {
  LocalContact contact(K, 0);
  contact.take(convex_edge(), dt);
  const ContactResult felt = contact.tick({-0.01, 0, -0.003}, Vec3::Zero(), dt);
  EXPECT_LE(felt.force.norm(), 0.1 + 1e-12);
}

TEST(LocalContact, FollowsANewPlaneOverOnePatchPeriod) {
  LocalContact contact(K, 0);
  ContactPatch patch = convex_edge();
  contact.take(patch, 0.05);
  walk(contact, {-0.01, 0, 0.001}, {-0.01, 0, -0.002}, 100, [](const Vec3&, const ContactResult&) {});
  for (auto& f : patch.facets) f.point[2] -= 0.001;
  patch.facets[2].point[2] = patch.facets[3].point[2] = 0;
  contact.take(patch, 0.05);
  double last = K * 0.002;
  for (int i = 0; i < 50; ++i) {
    const double f = contact.tick({-0.01, 0, -0.002}, Vec3::Zero(), dt).force.z();
    ASSERT_NEAR(last - f, K * 0.001 / 50, 1e-6);
    last = f;
  }
  EXPECT_NEAR(last, K * 0.001, 1e-6);
}

TEST(LocalContact, DampsOnlyUpToHalfTheSpringOnTheWayInAndNeverPulls) {
  LocalContact contact(K, 2);
  contact.take(convex_edge(), dt);
  contact.tick({-0.01, 0, 0.0005}, {0, 0, -0.5}, dt);
  const ContactResult in = contact.tick({-0.01, 0, -0.0001}, {0, 0, -0.5}, dt);
  EXPECT_NEAR(in.force.z(), 1.5 * K * 0.0001, 1e-6);
  const ContactResult out = contact.tick({-0.01, 0, -0.0001}, {0, 0, 0.5}, dt);
  EXPECT_NEAR(out.force.z(), 0, 1e-9);
}

TEST(LocalContact, SaysWhenTheToolOutranItsPatch) {
  LocalContact contact(K, 0);
  ContactPatch patch;
  add_square(patch, {-0.01, -0.01, 0}, {0.01, -0.01, 0}, {0.01, 0.01, 0}, {-0.01, 0.01, 0}, {0, 0, 1});
  contact.take(patch, dt);
  bool outran = false;
  walk(contact, {0, 0, 0.001}, {0, 0, -0.002}, 100, [](const Vec3&, const ContactResult&) {});
  walk(contact, {0, 0, -0.002}, {0.03, 0, -0.002}, 300,
       [&](const Vec3&, const ContactResult& felt) { outran = outran || felt.outran; });
  EXPECT_TRUE(outran);
  EXPECT_EQ(contact.tick({0.03, 0, -0.002}, Vec3::Zero(), dt).force.norm(), 0.0);
}

}  // namespace
}  // namespace palpate::haptic
