#pragma once
// One-line worlds for tests of the eye: surfaces of filled cells, cut into the messages that physics would send.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/scene_fwd.h"
#include "render_node/model/surface.h"
#include "render_node/picture.h"
#include "render_node/view/camera.h"

namespace palpate::render::test {

struct VoxelSurface {
  std::vector<Array3f> position;
  std::vector<std::array<std::uint32_t, 4>> corners;
  std::vector<std::uint32_t> rgba;
  std::uint32_t facets_hidden = 0;
};

/// The faces between filled and empty cells, counter-clockwise from outside; corners are shared.
/// @param origin  of the corner of cell (0, 0, 0) [m]  @param spacing  of the cells [m]
VoxelSurface voxel_surface(std::array<int, 3> size, std::array<double, 3> spacing,
                           std::array<double, 3> origin, const std::function<bool(int, int, int)>& filled,
                           const std::function<std::uint32_t(int, int, int)>& rgba);

/// A solid cube of n cells a side round the origin, all of one colour.
VoxelSurface cube_surface(int n, double side_m, std::uint32_t rgba);

/// As the eye has it when it has come whole.
Surface surface_of(const VoxelSurface& made);

int pixels_that_differ(const Image& a, const Image& b);

std::vector<BodySurface> chunks_of(const VoxelSurface& surface, std::uint32_t body, std::uint32_t revision);

/// All vertices of one block as they stand in the surface.
VertexBlock block_of(const VoxelSurface& surface, std::uint32_t body, std::uint32_t revision,
                     std::uint32_t block);

void show(Picture& picture, const VoxelSurface& surface, std::uint32_t revision = 1);

/// The camera of a picture of a cube round the origin, as the picture sets it up.
Camera camera_of_cube(const Scene& scene, double side_m);

/// A scene with one body and one tool, 320 x 240 pixels, looking along +y, without panels.
Scene small_scene();

HapticTrace trace_at(std::array<double, 3> tip, double t, double newton);

}  // namespace palpate::render::test
