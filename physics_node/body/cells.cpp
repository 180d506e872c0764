#include "physics_node/body/cells.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/units.h"
#include "physics_node/body/deformable.h"

namespace palpate::physics {
namespace {

bool contains(const SphereShape& shape, const Vec3& p) { return p.norm() <= shape.radius; }
bool contains(const BoxShape& shape, const Vec3& p) {
  return (p.array().abs() <= 0.5 * shape.size.array()).all();
}
bool contains(const TubeShape& shape, const Vec3& p) {
  const double along = p[shape.axis];
  const double across = std::sqrt(std::max(0.0, p.squaredNorm() - along * along));
  return std::abs(along) <= 0.5 * shape.length && across <= shape.outer_radius &&
         across >= shape.inner_radius;
}

Vec3 extent_of(const SphereShape& shape) { return Vec3::Constant(2 * shape.radius); }
Vec3 extent_of(const BoxShape& shape) { return shape.size; }
Vec3 extent_of(const TubeShape& shape) {
  Vec3 extent = Vec3::Constant(2 * shape.outer_radius);
  extent[shape.axis] = shape.length;
  return extent;
}

template <class S>
Cells solid_cells(const BodySpec& body, const S& shape) {
  Cells cells;
  cells.spacing = Vec3::Constant(*body.spacing);
  cells.size = (extent_of(shape) / *body.spacing).array().round().max(1.0).template cast<int>();
  cells.corner = body.at - 0.5 * cells.spacing.cwiseProduct(cells.size.cast<double>());
  cells.filled.assign(static_cast<std::size_t>(cells.size.cast<std::int64_t>().prod()), 0);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        const Vec3 centre =
            cells.corner + cells.spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5)) - body.at;
        cells.filled[cells.index(i, j, k)] = contains(shape, centre) ? 1 : 0;
      }
  cells.deformable = cells.filled;
  return cells;
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
  Volume volume = read_volume(shape.file);
  if (shape.partition) volume = resample(volume, *shape.partition);
  Cells cells;
  cells.size = {volume.size[0], volume.size[1], volume.size[2]};
  cells.spacing = body.spacing ? Vec3::Constant(*body.spacing) : volume.spacing;
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
  if (shape.largest_component) keep_largest_component(cells);
  mark_deformable(cells, shape.deformable);
  cells.intensity = std::move(volume.intensity);
  cells.transfer = std::move(volume.transfer);
  // An image whose axes are left-handed would stand in the world as its mirror image: a left ear on the right.
  if (volume.orientation && volume.orientation->determinant() < 0) mirror_x(cells);
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
  Cells cells = std::visit(
      [&](const auto& shape) {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, VolumeShape>) {
          return volume_cells(body, shape);
        } else {
          return solid_cells(body, shape);
        }
      },
      body.shape);
  if (cells.n_deformable() == 0) {
    throw InputError(
        fmt::format("{}: body \"{}\" has no deformable tissue; its shape must be larger than one cell, or "
                    "the deformable region must reach filled voxels (partition {} x {} x {})",
                    body.place.text(), body.name, cells.size.x(), cells.size.y(), cells.size.z()));
  }
  return cells;
}

}  // namespace palpate::physics
