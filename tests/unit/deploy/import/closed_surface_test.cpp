// Triangles become a surface that has an inside.
#include "deploy/import/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "common/error/error.h"
#include "deploy/import/surface_winding.h"
#include "tests/unit/deploy/import/made_surfaces.h"

namespace palpate::test {
namespace {

TriangleSurface turned(TriangleSurface surface) {
  for (Corners& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

/// Each triangle with points of its own, as STL has it.
TriangleSurface soup(const TriangleSurface& surface, double off) {
  TriangleSurface apart;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t n = 0; n < 3; ++n)
      apart.points.push_back(surface.corner(t, n) + Vec3::Constant(t % 2 == 0 ? 0 : off));
    const auto at = static_cast<std::int32_t>(3 * t);
    apart.triangles.push_back({at, at + 1, at + 2});
  }
  return apart;
}

std::string complaint(const TriangleSurface& surface) {
  try {
    close_surface(surface, "a.obj");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

constexpr double pi = std::numbers::pi;

TEST(ClosedSurface, HasTheVolumeOfClosedForms) {
  EXPECT_NEAR(close_surface(made_cube(0.01), "a").volume, 1e-6, 1e-18);
  EXPECT_NEAR(close_surface(made_ball(0.02), "a").volume / (4 * pi / 3 * 8e-6), 1, 4e-3);
  EXPECT_NEAR(close_surface(made_torus(0.03, 0.01), "a").volume / (2 * pi * pi * 3e-6), 1, 2e-2);
  EXPECT_NEAR(close_surface(made_cube(0.01, Vec3::Constant(900)), "a").volume, 1e-6, 1e-15);
}

TEST(ClosedSurface, WeldsWhatIsOnePoint) {
  const ClosedSurface one = close_surface(soup(made_cube(0.01), 0), "a");
  EXPECT_EQ(one.surface.points.size(), 8U);
  EXPECT_EQ(one.mended.welded, 0U);
  const ClosedSurface near = close_surface(soup(made_cube(0.01), 5e-9), "a");
  EXPECT_EQ(near.surface.points.size(), 8U);
  EXPECT_GT(near.mended.welded, 0U);
  EXPECT_EQ(complaint(soup(made_cube(0.01), 1e-6)).substr(0, 54),
            "a.obj: the surface is open: edges of one triangle: 36,");
}

TEST(ClosedSurface, LeavesOutWhatHasNoArea) {
  TriangleSurface cube = made_cube(0.01);
  cube.points.push_back(Vec3::Constant(5));
  cube.triangles.push_back({3, 3, 7});
  const ClosedSurface closed = close_surface(cube, "a");
  EXPECT_EQ(closed.surface.triangles.size(), 12U);
  EXPECT_EQ(closed.mended.degenerate, 1U);
  EXPECT_EQ(closed.mended.unused, 1U);
}

TEST(ClosedSurface, TurnsTriangles) {
  TriangleSurface cube = made_cube(0.01);
  EXPECT_EQ(close_surface(cube, "a").mended.turned, 0U);
  std::swap(cube.triangles[4][1], cube.triangles[4][2]);
  std::swap(cube.triangles[7][1], cube.triangles[7][2]);
  EXPECT_EQ(close_surface(cube, "a").mended.turned, 2U);
  EXPECT_NEAR(close_surface(cube, "a").volume, 1e-6, 1e-18);
  EXPECT_EQ(close_surface(turned(cube), "a").mended.turned, 10U);
  EXPECT_NEAR(close_surface(turned(cube), "a").volume, 1e-6, 1e-18);
}

/// Whichever way round the file has them.
TEST(ClosedSurface, PartsWithinPartsAreHolesAndWithinTheseNone) {
  const TriangleSurface large = made_ball(0.03), hole = made_ball(0.02), core = made_ball(0.01);
  const double volume = enclosed_volume(large) - enclosed_volume(hole) + enclosed_volume(core);
  const ClosedSurface closed = close_surface(both(both(core, large), hole), "a");
  EXPECT_EQ(closed.parts, 3U);
  EXPECT_NEAR(closed.volume / volume, 1, 1e-9);
  EXPECT_EQ(closed.mended.turned, hole.triangles.size());
  EXPECT_EQ(close_surface(both(both(core, large), turned(hole)), "a").mended.turned, 0U);
  const SurfaceWinding winding(closed.surface);
  EXPECT_EQ(winding.at(Vec3(0.025, 0, 0.001)), 1);
  EXPECT_EQ(winding.at(Vec3(0.015, 0, 0.001)), 0);
  EXPECT_EQ(winding.at(Vec3(0.005, 0, 0.001)), 1);
  EXPECT_EQ(close_surface(both(large, made_ball(0.01, Vec3(0.05, 0, 0))), "a").mended.turned, 0U);
}

TEST(ClosedSurface, SaysWhereItIsOpen) {
  TriangleSurface ball = made_ball(0.02);
  ball.triangles.erase(ball.triangles.begin());  // 0, 2, 1 at the lower pole
  const std::string said = complaint(ball);
  EXPECT_EQ(said.substr(0, said.find("first at")),
            "a.obj: the surface is open: edges of one triangle: 3, the ");
  TriangleSurface cube = made_cube(0.01);
  cube.triangles.pop_back();
  EXPECT_EQ(
      complaint(cube),
      "a.obj: the surface is open: edges of one triangle: 3, the first at 10, 5, 10 mm; close its holes");
}

TEST(ClosedSurface, SaysWhereThreeTrianglesMeet) {
  TriangleSurface cube = made_cube(0.01);
  cube.points.push_back(Vec3(0.02, 0.02, 0.02));
  cube.triangles.push_back({6, 7, 8});
  EXPECT_EQ(
      complaint(cube),
      "a.obj: edges of more than two triangles: 1, the first at 5, 10, 10 mm; where parts touch, move them "
      "apart or make them one, and leave out walls inside");
  EXPECT_EQ(complaint(both(made_cube(0.01), made_cube(0.01, Vec3(0.01, 0.01, 0)))).substr(0, 43),
            "a.obj: edges of more than two triangles: 1,");
}

TEST(ClosedSurface, SaysThatItHasNoInside) {
  TriangleSurface flat{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_EQ(complaint(flat), "a.obj: the surface encloses nothing: its sides lie upon each other");
  EXPECT_EQ(complaint({flat.points, {{0, 0, 1}}}),
            "a.obj: all of its triangles are points or lines, so nothing is inside of it");
  // A Klein bottle: the other way round after one turn.
  TriangleSurface bottle = made_ring(40, 21, [](double u, double v) {
    const double a = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
    const double b = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
    return Vec3((3 + a) * std::cos(u), (3 + a) * std::sin(u), b);
  });
  for (auto& t : bottle.triangles)  // the last ring meets the first one turned round
    if (std::ranges::max(t) >= 39 * 21 && std::ranges::min(t) < 21)
      for (std::int32_t& p : t)
        if (p < 21) p = (21 - p) % 21;
  EXPECT_EQ(complaint(bottle).substr(0, 57), "a.obj: the surface has one side only, as a Klein bottle, ");
}

TEST(ClosedSurface, SeesTrianglesThatGoThroughOthers) {
  EXPECT_EQ(complaint(both(made_ball(0.02), made_ball(0.02, Vec3(0.0301, 0.0002, 0.0003)))).substr(0, 50),
            "a.obj: its parts go through each other, first at 1");
  TriangleSurface ball = made_ball(0.02);
  EXPECT_EQ(close_surface(ball, "a").mended.cutting, 0U);
  ball.points[0] = Vec3(0.001, 0.002, 0.03);  // the lower pole is pulled out through the upper one
  const ClosedSurface spiked = close_surface(ball, "a");
  EXPECT_GT(spiked.mended.cutting, 70U);
  EXPECT_GT(spiked.volume, 0);
}

/// Rays through corners and along faces.
TEST(SurfaceWinding, IsWholeWhereverTheRayGoes) {
  const TriangleSurface cube = made_cube(4);
  const SurfaceWinding winding(cube);
  for (int i = -1; i < 10; ++i)
    for (int j = -1; j < 10; ++j)
      for (int k = -1; k < 10; ++k) {
        const Vec3 x = 0.5 * Vec3(i, j, k);
        const double far = (x.array() - 2).abs().maxCoeff();
        if (far == 2) continue;
        EXPECT_EQ(winding.at(x), far < 2 ? 1 : 0) << x.transpose();
      }
}

TEST(SurfaceWinding, CountsPartsThatOverlapTwice) {
  const TriangleSurface two = both(made_ball(0.02), made_ball(0.02, Vec3(0.02, 0, 0)));
  const SurfaceWinding winding(two);
  EXPECT_EQ(winding.at(Vec3(0.01, 0, 0)), 2);
  EXPECT_EQ(winding.at(Vec3(-0.01, 0, 0)), 1);
  EXPECT_EQ(winding.at(Vec3(0.05, 0, 0)), 0);
}

}  // namespace
}  // namespace palpate::test
