// What a closed surface of springs is made of.
#include "physics_node/body/spring_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support/physics/made_sphere.h"

namespace palpate::physics {
namespace {

constexpr Membrane membrane{.modulus = 50e3, .thickness = 2e-3, .density = 1100};

/// Between two equilateral triangles k = sqrt(3) / 2 E t.
TEST(SpringSurface, SpringsOfEquilateralTrianglesAreThoseOfTheSheet) {
  const SpringSurface icosahedron = spring_surface(palpate::test::made_sphere(0.02, 0), membrane);
  ASSERT_EQ(icosahedron.springs.size(), 30u);
  for (const SurfaceSpring& spring : icosahedron.springs)
    EXPECT_NEAR(spring.k, std::sqrt(3.0) / 2 * 50e3 * 2e-3, 1e-9);
}

TEST(SpringSurface, HasTheMassOfItsTrianglesAndTheirSpringsByFirstNode) {
  const SpringSurface sphere = spring_surface(palpate::test::made_sphere(0.02, 2), membrane);
  double area = 0;
  for (const MeshTriangle& corners : sphere.mesh.triangles) area += area_of(sphere.mesh, corners);
  const double mass = std::accumulate(sphere.mass.begin(), sphere.mass.end(), 0.0);
  EXPECT_NEAR(mass, 1100 * 2e-3 * area, 1e-12 * mass);
  EXPECT_TRUE(std::ranges::is_sorted(sphere.mesh.triangles));
  EXPECT_TRUE(std::ranges::is_sorted(sphere.springs, {}, &SurfaceSpring::node));
  EXPECT_DOUBLE_EQ(sphere.volume, enclosed_volume(sphere.mesh));
}

}  // namespace
}  // namespace palpate::physics
