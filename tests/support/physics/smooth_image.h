#pragma once
// Bodies with a smooth skin from made images of 2 mm cells, and what a surface is to be.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "physics_node/boundary/surface.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"

namespace palpate::physics::test {

/// phi(p) > 0: tissue, whose intensity is 1000 + 100 phi / mm; p in mm from the middle of the image.
using Shape3 = std::function<double(const Vec3&)>;

inline Shape3 ball_mm(double radius, const Vec3& centre = Vec3::Zero()) {
  return [=](const Vec3& p) { return radius - (p - centre).norm(); };
}

struct SmoothImage {
  std::array<int, 3> size{24, 24, 24};
  Shape3 phi = ball_mm(18.3, Vec3(0.37, -0.21, 0.55));
  SkinKind skin = SkinKind::smooth;
  ElementModel model = ElementModel::fem;
  BorderCells border = BorderCells::whole;
  std::array<bool, 6> fixed{};
  bool breaks = false;

  BodySpec spec(const palpate::test::ScratchFolder& folder) const {
    const std::string path = folder / "made.h5";
    write_volume(made_volume(size,
                             [this](int i, int j, int k) {
                               const Vec3 p(2 * i + 1 - size[0], 2 * j + 1 - size[1], 2 * k + 1 - size[2]);
                               return static_cast<float>(1000 + 100 * phi(p));
                             }),
                 path);
    BodySpec body = volume_body(path, 1000, 1e9);
    body.border = {border, skin};
    body.model = model;
    body.fixed_faces = fixed;
    return body;
  }
  Body body() const {
    const palpate::test::ScratchFolder folder;
    MaterialSpec material = soft_material();
    material.viscosity = 1;
    if (breaks) material.break_ratio = 1.5;
    return build_body(spec(folder), material);
  }
};

/// Edges that are not passed as often one way as the other, edges of four facets, and vertices whose facets do not
/// hang together.
struct Defects {
  int open_edges = 0, edges_of_four = 0, bad_vertices = 0;
};
inline Defects defects_of(const Surface& surface) {
  Defects found;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  // At each vertex the neighbours that its facets join.
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> joined;
  for (const auto& f : surface.facets) {
    const std::size_t n = f[2] == f[3] ? 3 : 4;
    for (std::size_t c = 0; c < n; ++c) {
      const std::uint32_t next = f[(c + 1) % n], before = f[(c + n - 1) % n];
      ++edges[{f[c], next}];
      auto& at = joined[f[c]];
      const auto root = [&](std::uint32_t v) {
        at.try_emplace(v, v);
        while (at[v] != v) v = at[v];
        return v;
      };
      const std::uint32_t one = root(next), other = root(before);
      at[one] = other;
    }
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    const int other = back == edges.end() ? 0 : back->second;
    if (other != count) ++found.open_edges;
    if (count > 1 && edge.first < edge.second) ++found.edges_of_four;
  }
  for (const auto& [vertex, at] : joined) {
    int pieces = 0;
    for (const auto& [neighbour, to] : at) pieces += neighbour == to ? 1 : 0;
    if (pieces != 1) ++found.bad_vertices;
  }
  return found;
}

}  // namespace palpate::physics::test
