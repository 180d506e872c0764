#include "physics_node/mesh/tet_box.h"

#include <random>

namespace palpate::physics {
namespace {

using Corners = std::array<Index, 4>;  // bit 0 is +x, bit 1 +y, bit 2 +z

constexpr std::array<Corners, 6> six = {
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
constexpr std::array<Corners, 5> five = {
    {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}}};

}  // namespace

TetMesh make_tet_box(const TetBox& box) {
  TetMesh mesh;
  const auto [nx, ny, nz] = box.cells;
  const auto node = [nx = nx, ny = ny](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  std::mt19937_64 engine(box.seed);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const bool inner = i > 0 && i < nx && j > 0 && j < ny && k > 0 && k < nz;
        Vec3 x(i, j, k);
        if (inner)
          for (double& entry : x) entry += box.jitter * dice();
        mesh.nodes.push_back(box.edge * x);
      }
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto add = [&, i, j, k](Corners corners, int mirrored) {
          for (Index& c : corners)
            c = node(i + ((c ^ mirrored) & 1), j + ((c ^ mirrored) >> 1 & 1), k + (c >> 2));
          if (signed_volume(mesh, corners) < 0) std::swap(corners[2], corners[3]);
          mesh.tets.push_back(corners);
        };
        // Why mirrored in x: the diagonals of a face are those of its neighbour only if one of the two is.
        if (box.split == CubeSplit::five)
          for (const Corners& corners : five) add(corners, (i + j + k) & 1);
        else
          for (const Corners& corners : six) add(corners, 0);
      }
  mesh.region.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace palpate::physics
