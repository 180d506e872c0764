#pragma once
// Closed surfaces of known volume, and the bytes that other programs would write of them. All anticlockwise from outside.

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>

#include "deploy/import/triangle_surface.h"

namespace palpate::test {

/// Corners at 0 and `side`.
inline TriangleSurface made_cube(double side, const Vec3& low = Vec3::Zero()) {
  TriangleSurface cube;
  for (int n = 0; n < 8; ++n) cube.points.push_back(low + side * Vec3(n & 1, n >> 1 & 1, n >> 2));
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return cube;
}

/// A grid of n x m that closes in both directions. @param at  of two angles
inline TriangleSurface made_ring(int n, int m, const std::function<Vec3(double, double)>& at) {
  TriangleSurface ring;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      ring.points.push_back(at(2 * std::numbers::pi * i / n, 2 * std::numbers::pi * j / m));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                d = i * m + (j + 1) % m;
      ring.triangles.push_back({a, b, c});
      ring.triangles.push_back({a, c, d});
    }
  return ring;
}

inline TriangleSurface made_torus(double large, double small, int n = 60, int m = 30) {
  return made_ring(n, m, [=](double u, double v) {
    const double r = large + small * std::cos(v);
    return Vec3(r * std::cos(u), r * std::sin(u), small * std::sin(v));
  });
}

/// Rings of points between two poles.
inline TriangleSurface made_ball(double radius, const Vec3& middle = Vec3::Zero(), int n = 40) {
  TriangleSurface ball;
  ball.points.push_back(middle - radius * Vec3::UnitZ());
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double u = std::numbers::pi * i / n, v = std::numbers::pi * j / n;
      ball.points.push_back(
          middle + radius * Vec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), -std::cos(u)));
    }
  ball.points.push_back(middle + radius * Vec3::UnitZ());
  const int top = static_cast<int>(ball.points.size()) - 1, ring = 2 * n;
  for (int j = 0; j < ring; ++j) {
    const int k = (j + 1) % ring;
    ball.triangles.push_back({0, 1 + k, 1 + j});
    ball.triangles.push_back({top, top - ring + j, top - ring + k});
    for (int i = 0; i + 2 < n; ++i) {
      const int a = 1 + i * ring;
      ball.triangles.push_back({a + j, a + k, a + ring + k});
      ball.triangles.push_back({a + j, a + ring + k, a + ring + j});
    }
  }
  return ball;
}

inline TriangleSurface both(TriangleSurface one, const TriangleSurface& other) {
  const auto more = static_cast<std::int32_t>(one.points.size());
  one.points.insert(one.points.end(), other.points.begin(), other.points.end());
  for (const Corners& t : other.triangles) one.triangles.push_back({t[0] + more, t[1] + more, t[2] + more});
  return one;
}

inline std::string as_obj(const TriangleSurface& surface) {
  std::string text = "# made\n";
  for (const Vec3& x : surface.points) text += fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
  for (const Corners& t : surface.triangles)
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// Points and triangles as OFF and PLY have them.
inline std::string points_and_triangles(const TriangleSurface& surface) {
  std::string text;
  for (const Vec3& x : surface.points) text += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  for (const Corners& t : surface.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}
inline std::string as_off(const TriangleSurface& surface) {
  return fmt::format("OFF\n{} {} 0\n", surface.points.size(), surface.triangles.size()) +
         points_and_triangles(surface);
}
inline std::string as_ply(const TriangleSurface& surface) {
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
             "z\n"
             "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
             surface.points.size(), surface.triangles.size()) +
         points_and_triangles(surface);
}

inline std::string as_stl(const TriangleSurface& surface) {
  std::string text = "solid made\n";
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3& x = surface.corner(t, n);
      text += fmt::format("vertex {} {} {}\n", x.x(), x.y(), x.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid made\n";
}
inline std::string as_binary_stl(const TriangleSurface& surface) {
  std::string bytes(80, ' ');
  const auto put = [&bytes](auto value) {
    std::array<char, sizeof(value)> of{};
    std::memcpy(of.data(), &value, sizeof(value));
    bytes.append(of.data(), of.size());
  };
  put(static_cast<std::uint32_t>(surface.triangles.size()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (int n = 0; n < 3; ++n) put(0.0F);
    for (std::size_t n = 0; n < 3; ++n)
      for (const double entry : surface.corner(t, n)) put(static_cast<float>(entry));
    put(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace palpate::test
