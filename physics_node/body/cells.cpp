#include "physics_node/body/cells.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/slice_stack.h"
#include "common/scene/body_spec.h"
#include "physics_node/body/border_cells.h"
#include "physics_node/body/deformable.h"
#include "physics_node/body/skin_crossings.h"
#include "physics_node/body/solid_shape.h"

namespace palpate::physics {
namespace {

/// Empties the cells of a tube that are further in than so many layers, each one face further from the outside.
void keep_outer_cells(const BodySpec& body, int axis, int layers, Cells& cells) {
  std::vector<int> layer(cells.filled.size(), 0);
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const std::array<Vec3i, 4> sides{Vec3i::Unit(b), -Vec3i::Unit(b), Vec3i::Unit(c), -Vec3i::Unit(c)};
  for (int n = 1; n <= layers; ++n)
    for (int k = 0; k < cells.size.z(); ++k)
      for (int j = 0; j < cells.size.y(); ++j)
        for (int i = 0; i < cells.size.x(); ++i) {
          auto& mine = layer[cells.index(i, j, k)];
          if (mine != 0 || !cells.is_filled(i, j, k)) continue;
          for (const Vec3i& side : sides) {
            const Vec3i at = Vec3i(i, j, k) + side;
            const bool beyond = beyond_outer_wall(body, cells.centre_of(at.x(), at.y(), at.z()) - body.at);
            const bool behind = n > 1 && cells.is_filled(at.x(), at.y(), at.z()) &&
                                layer[cells.index(at.x(), at.y(), at.z())] == n - 1;
            if (n == 1 ? beyond : behind) mine = n;
          }
        }
  bool hollow = false;
  for (std::size_t n = 0; n < layer.size(); ++n) {
    hollow = hollow || (cells.filled[n] != 0 && layer[n] == 0);
    cells.filled[n] = layer[n] != 0 ? 1 : 0;
  }
  if (!hollow)
    throw InputError(fmt::format("{}: body \"{}\" is filled by its wall; make it wider or spacing_mm smaller",
                                 body.place.text(), body.name));
}

Cells solid_cells(const BodySpec& body) {
  Cells cells;
  const Bounds bounds = bounds_of(body);
  cells.spacing = Vec3::Constant(*body.spacing);
  Eigen::Array3d edges = (bounds.hi - bounds.lo).array() / *body.spacing;
  // Filled cells hold what is left over beyond whole ones.
  const bool filled = body.border.cells == BorderCells::filled;
  for (Eigen::Index a = 0; a < 3 && !filled; ++a)
    if (edges[a] < 0.499)
      throw InputError(
          fmt::format("{}: body \"{}\" is {:.4g} mm along {}, less than half of a cell of {:.4g} mm; make "
                      "spacing_mm smaller",
                      body.place.text(), body.name, mm_from_m((bounds.hi - bounds.lo)[a]), "xyz"[a],
                      mm_from_m(*body.spacing)));
  edges = filled ? Eigen::Array3d((edges - 1e-6).ceil()) : Eigen::Array3d(edges.round());
  cells.size = edges.max(1.0).cast<int>();
  cells.corner = body.at - 0.5 * cells.spacing.cwiseProduct(cells.size.cast<double>());
  cells.filled.assign(static_cast<std::size_t>(cells.size.cast<std::int64_t>().prod()), 0);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i)
        cells.filled[cells.index(i, j, k)] = holds(body, cells.centre_of(i, j, k) - body.at, 0.0) ? 1 : 0;
  if (const auto layers = wall_layers_of(body))
    keep_outer_cells(body, std::get<TubeShape>(body.shape).axis, *layers, cells);
  return cells;
}

/// @param mirrored  x will be turned round later
void carve(const BodySpec& body, bool mirrored, Cells& cells) {
  if (body.cavities.empty()) return;
  Carver carver(body);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        auto& filled = cells.filled[cells.index(i, j, k)];
        const int in_world = mirrored ? cells.size.x() - 1 - i : i;
        if (filled != 0 && carver.takes(cells.centre_of(in_world, j, k))) filled = 0;
      }
  carver.refuse_unused();
}

void mirror_x(Cells& cells) {
  const auto nx = static_cast<std::size_t>(cells.size.x());
  for (std::size_t row = 0; row < cells.filled.size(); row += nx) {
    const auto mirror = [&](auto& values) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(row);
      std::reverse(first, first + static_cast<std::ptrdiff_t>(nx));
    };
    mirror(cells.filled);
    mirror(cells.deformable);
    mirror(cells.intensity);
  }
}

Cells volume_cells(const BodySpec& body, const VolumeShape& shape) {
  Volume volume =
      shape.slices ? read_slices(shape.slices->files, shape.slices->spacing) : read_volume(shape.file);
  if (shape.partition) volume = resample(volume, *shape.partition);
  Cells cells;
  cells.size = {volume.size[0], volume.size[1], volume.size[2]};
  cells.spacing = volume.spacing;
  cells.corner = body.at - 0.5 * cells.spacing.cwiseProduct(cells.size.cast<double>());
  cells.filled.resize(volume.n_cells());
  for (std::size_t n = 0; n < volume.n_cells(); ++n) {
    const auto value = static_cast<double>(volume.intensity[n]);
    cells.filled[n] = value >= shape.keep_min && value <= shape.keep_max ? 1 : 0;
  }
  if (cells.n_filled() == 0) {
    const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
    throw InputError(
        fmt::format("{}: body \"{}\" keeps no voxel between {} and {}; the image goes from {} to {}",
                    body.place.text(), body.name, shape.keep_min, shape.keep_max, *lo, *hi));
  }
  // An image whose axes are left-handed would stand in the world as its mirror image: a left ear on the right.
  const bool mirrored = volume.is_left_handed();
  carve(body, mirrored, cells);
  if (shape.largest_component) keep_largest_component(cells);
  mark_deformable(cells, shape.deformable);
  cells.intensity = std::move(volume.intensity);
  cells.transfer = std::move(volume.transfer);
  if (mirrored) mirror_x(cells);
  return cells;
}

}  // namespace

std::size_t Cells::n_filled() const {
  return static_cast<std::size_t>(std::count(filled.begin(), filled.end(), std::uint8_t{1}));
}
std::size_t Cells::n_deformable() const {
  return static_cast<std::size_t>(std::count(deformable.begin(), deformable.end(), std::uint8_t{1}));
}

Cells make_cells(const BodySpec& body) {
  Cells cells;
  if (const auto* image = std::get_if<VolumeShape>(&body.shape)) {
    cells = volume_cells(body, *image);
  } else {
    cells = solid_cells(body);
    carve(body, false, cells);
    cells.deformable = cells.filled;
  }
  if (cells.n_deformable() == 0) {
    throw InputError(
        fmt::format("{}: body \"{}\" has no deformable tissue; its shape must be larger than one cell, or "
                    "the deformable region must reach filled voxels (partition {} x {} x {})",
                    body.place.text(), body.name, cells.size.x(), cells.size.y(), cells.size.z()));
  }
  if (body.border.cells == BorderCells::filled) fill_border_cells(body, cells);
  if (body.border.skin == SkinKind::smooth) find_crossings(body, cells);
  return cells;
}

}  // namespace palpate::physics
