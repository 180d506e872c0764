#pragma once
// The shapes that a body can have.

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/math/vec3.h"

namespace palpate {

struct SphereShape {
  double radius = 0;
};
struct BoxShape {
  Vec3 size = Vec3::Zero();
};
struct TubeShape {
  double outer_radius = 0, inner_radius = 0, length = 0;
  int axis = 2;
  /// Instead of inner_radius: masses (fcc) or cells (voxel) from the outside in.
  std::optional<int> wall_layers{};
};
/// A plate one cell thick. Where all angles are 0 its edge runs from the tip along +x, the blade stands up
/// along +z from the edge, and its sides look to -y and +y.
struct KnifeShape {
  double length = 0, height = 0;
};
/// A bevelled tube with a wall of one cell. Where all angles are 0 it points down: the shaft runs from the
/// tip along +z, and the opening of the bevel looks to +x.
struct NeedleShape {
  double length = 0, diameter = 0;  // diameter: outer
  double sharpening = 0;            // angle between the plane of the bevel and the axis, (0, pi/2] [rad]
};
struct DeformableRegion {
  bool all = true;                    // or the kept cells within radius_voxels (Chebyshev) of the centre
  std::array<int, 3> center_voxel{};  // in the partition used
  int radius_voxels = 10;
  bool gravity_center = false;    // centre: of gravity of all kept cells, not center_voxel
  std::optional<int> nearest{};   // instead of the radius: so many kept cells, the nearest to the centre
  std::optional<double> awake{};  // of all: only what is within this of where it is pressed is stepped [m]
};
/// Pictures of parallel planes, the lowest first.
struct SliceStack {
  std::vector<std::string> files;  // PNG, found from the folder of the scene file
  Vec3 spacing = Vec3::Zero();     // of pixels along a row, of rows, of planes [m]
};
struct VolumeShape {
  std::string file;                             // found from the folder of the scene file
  std::optional<SliceStack> slices{};           // instead of the file
  double keep_min = 0, keep_max = 0;            // intensity window that is tissue, inclusive
  std::optional<std::array<int, 3>> partition;  // resample to nx, ny, nz cells; absent: as stored
  DeformableRegion deformable;
  bool largest_component = false;  // keep only the largest 6-connected component
};
/// Tetrahedra from a file: an .h5 of palpate import, or Gmsh's format MSH 2.2. The middle of the box round them comes to `at`.
struct MeshShape {
  std::string file;   // found from the folder of the scene file
  double metres = 0;  // that one unit of the file has; of an .h5 1
};
using Shape = std::variant<SphereShape, BoxShape, TubeShape, KnifeShape, NeedleShape, VolumeShape, MeshShape>;

}  // namespace palpate
