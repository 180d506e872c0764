#pragma once
// Which region of a [[body]] holds what of it.

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "common/scene/body_spec.h"
#include "physics_node/body/body.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/solid_shape.h"

namespace palpate::physics {

inline bool holds_mass(const RegionSpec& region, const Vec3& p, double intensity) {
  if (const auto* box = std::get_if<BoxRegion>(&region.where)) return holds(*box, p);
  if (const auto* ball = std::get_if<BallRegion>(&region.where)) return holds(*ball, p);
  const auto* window = std::get_if<IntensityRegion>(&region.where);
  if (window == nullptr) return false;  // groups are of a mesh
  return intensity >= window->lo && intensity <= window->hi;
}

/// 0: the body's own material; r + 1: that of region r. Remembers which regions hold anything.
class RegionMap {
 public:
  RegionMap(const Body& body, const BodySpec& spec)
      : body_(body), regions_(spec.regions), used_(spec.regions.size(), false) {
    if (body.cells) corner_ = lattice_corner(*body.cells, body.lattice);
  }

  std::size_t of_mass(Index cell) {
    if (body_.cells) return of_corner(cell);
    const auto n = static_cast<std::size_t>(cell);
    return of_point(body_.lattice.rest_position(cell),
                    body_.intensity.empty() ? 0.0 : static_cast<double>(body_.intensity[n]));
  }

  /// Of a voxel body: at the centre of a cell.
  std::size_t of_cell(const Vec3i& c) {
    const Cells& cells = *body_.cells;
    const double intensity = cells.intensity.empty()
                                 ? 0.0
                                 : static_cast<double>(cells.intensity[cells.index(c.x(), c.y(), c.z())]);
    return of_point(cells.centre_of(c.x(), c.y(), c.z()), intensity);
  }

  /// The first region that holds nothing, or none.
  std::optional<std::size_t> unused() const {
    const auto found = std::find(used_.begin(), used_.end(), false);
    return found == used_.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - used_.begin()));
  }

 private:
  std::size_t of_point(const Vec3& p, double intensity) {
    std::size_t last = 0;
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (!holds_mass(regions_[r], p, intensity)) continue;
      used_[r] = true;
      last = r + 1;
    }
    return last;
  }

  std::size_t of_corner(Index cell) {
    const Cells& cells = *body_.cells;
    const Vec3i at = corner_ + body_.lattice.grid_of(cell);
    std::array<std::size_t, 8> found{};
    std::size_t n = 0;
    for (int s = 0; s < 8; ++s) {
      const Vec3i c = at - Vec3i(s & 1, s >> 1 & 1, s >> 2);
      if (cells.share_of(c.x(), c.y(), c.z()) == 0) continue;
      found[n++] = of_cell(c);
    }
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto count = std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n), found[i]);
      if (count < most || (count == most && found[i] < best)) continue;
      most = count;
      best = found[i];
    }
    return best;
  }

  const Body& body_;
  const std::vector<RegionSpec>& regions_;
  std::vector<bool> used_;
  Vec3i corner_ = Vec3i::Zero();
};

}  // namespace palpate::physics
