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
    return build_body(spec(folder), material);
  }
};

/// Edges that are not passed once each way; and vertices whose facets do not hang together as one fan.
struct Defects {
  int open_edges = 0, edges_of_four = 0, bad_vertices = 0;
};
inline Defects defects_of(const Surface& surface) {
  Defects found;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> link;  // of a vertex, from corner to corner
  std::map<std::uint32_t, bool> twice;
  for (const auto& f : surface.facets) {
    const std::size_t n = f[2] == f[3] ? 3 : 4;
    for (std::size_t c = 0; c < n; ++c) {
      ++edges[{f[c], f[(c + 1) % n]}];
      if (!link[f[c]].emplace(f[(c + 1) % n], f[(c + n - 1) % n]).second) twice[f[c]] = true;
    }
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    const int other = back == edges.end() ? 0 : back->second;
    if (other != count) ++found.open_edges;
    if (count > 1) ++found.edges_of_four;
  }
  for (const auto& [vertex, next] : link) {
    std::size_t n = 0;
    for (auto at = next.begin(); at != next.end() && n <= next.size();) {
      ++n;
      at = next.find(at->second);
      if (at == next.begin()) break;
    }
    if (n != next.size() || twice.count(vertex) != 0) ++found.bad_vertices;
  }
  return found;
}

}  // namespace palpate::physics::test
