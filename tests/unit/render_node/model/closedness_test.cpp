#include "render_node/model/closedness.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

Surface cube() {
  auto made = test::cube_surface(5, 0.1, 0xffffffffU);
  Surface surface;
  surface.position = std::move(made.position);
  surface.corners = std::move(made.corners);
  return surface;
}

TEST(Closedness, HoldsForACube) { EXPECT_TRUE(is_closed(cube())); }

TEST(Closedness, IsLostWithOneFacet) {
  Surface surface = cube();
  surface.corners.pop_back();
  EXPECT_FALSE(is_closed(surface));
}

/// A slit whose lips lie on each other: two facets have a corner of their own where the others have one.
TEST(Closedness, IsLostWithAnOpenEdge) {
  Surface surface = cube();
  const std::uint32_t corner = surface.corners.front()[0];
  surface.position.push_back(surface.position[corner]);
  surface.corners.front()[0] = static_cast<std::uint32_t>(surface.position.size() - 1);
  EXPECT_FALSE(is_closed(surface));
}

TEST(Closedness, IsLostWhenTurnedInsideOut) {
  Surface surface = cube();
  for (auto& c : surface.corners) std::swap(c[1], c[3]);
  EXPECT_FALSE(is_closed(surface));
}

TEST(Closedness, DoesNotHoldForNothing) { EXPECT_FALSE(is_closed(Surface{})); }

}  // namespace
}  // namespace palpate::render
