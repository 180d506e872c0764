#include <unordered_map>

#include "physics_node/body/build_lattice.h"
#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/boundary/voxel_facets.h"

namespace palpate::physics {
namespace {

/// Gives every corner that a facet uses a number: masses of the lattice and points of the scenery apart.
class Numbering {
 public:
  explicit Numbering(const Body& body) : body_(body), shift_(lattice_corner(*body.cells, body.lattice)) {}

  /// Number of a corner, negative for scenery: the sign is resolved when the count of moving corners is known.
  std::int64_t number(const Vec3i& corner, Surface& surface) {
    const Vec3i& n = body_.cells->size;
    const std::int64_t key = corner.x() + (n.x() + 1LL) * (corner.y() + (n.y() + 1LL) * corner.z());
    const auto found = numbers_.find(key);
    if (found != numbers_.end()) return found->second;
    const Index cell = body_.lattice.mass_at(corner - shift_);
    std::int64_t value = 0;
    if (cell >= 0) {
      value = static_cast<std::int64_t>(surface.cell.size());
      surface.cell.push_back(cell);
    } else {
      scenery_.push_back(body_.cells->corner + body_.cells->spacing.cwiseProduct(corner.cast<double>()));
      value = -static_cast<std::int64_t>(scenery_.size());
    }
    numbers_.emplace(key, value);
    return value;
  }

  const std::vector<Vec3>& scenery() const { return scenery_; }

 private:
  const Body& body_;
  Vec3i shift_;
  std::unordered_map<std::int64_t, std::int64_t> numbers_;
  std::vector<Vec3> scenery_;
};

/// Collects the facets of one body.
class Builder {
 public:
  Builder(const Body& body, const LiveElements& live, std::optional<double> threshold, std::uint32_t rgba)
      : body_(body),
        cells_(*body.cells),
        cut_(body, live),
        numbering_(body),
        threshold_(cells_.intensity.empty() ? std::nullopt : threshold),
        rgba_(rgba) {}

  Surface build() {
    const auto is_shown = [this](const Vec3i& cell) { return shown(cell); };
    const VoxelFacets facets(cut_, is_shown);
    for (int k = 0; k < cells_.size.z(); ++k)
      for (int j = 0; j < cells_.size.y(); ++j)
        for (int i = 0; i < cells_.size.x(); ++i) {
          const Vec3i cell(i, j, k);
          if (!shown(cell)) continue;
          const auto take = [&](const FacetCorners& corners, bool) { add_facet(cell, corners); };
          for (const VoxelFace& face : voxel_faces) count_hidden(facets.on_face(cell, face, take));
        }
    for (const Vec3i& cell : cut_.cells())
      if (shown(cell))
        count_hidden(
            facets.inside(cell, [&](const FacetCorners& corners, bool) { add_facet(cell, corners); }));
    return finish();
  }

 private:
  bool shown(const Vec3i& cell) const {
    if (!cells_.is_filled(cell.x(), cell.y(), cell.z())) return false;
    return !threshold_ || intensity(cell) >= *threshold_;
  }
  double intensity(const Vec3i& cell) const {
    return static_cast<double>(cells_.intensity[cells_.index(cell.x(), cell.y(), cell.z())]);
  }
  void count_hidden(int facets) { surface_.hidden += static_cast<std::uint64_t>(facets); }

  void add_facet(const Vec3i& cell, const std::array<Vec3i, 4>& corners) {
    auto& facet = facets_.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) facet[c] = numbering_.number(corners[c], surface_);
    surface_.rgba.push_back(cells_.transfer.empty() ? rgba_ : rgba_of(cells_.transfer, intensity(cell)));
    surface_.site.push_back(static_cast<std::uint32_t>(cells_.index(cell.x(), cell.y(), cell.z())));
  }

  /// Puts the scenery behind the moving vertices.
  Surface finish() {
    for (const Index cell : surface_.cell) surface_.rest.push_back(body_.lattice.rest_position(cell));
    surface_.rest.insert(surface_.rest.end(), numbering_.scenery().begin(), numbering_.scenery().end());
    const auto n_moving = static_cast<std::int64_t>(surface_.cell.size());
    surface_.facets.reserve(facets_.size());
    for (const auto& facet : facets_) {
      auto& corners = surface_.facets.emplace_back();
      for (std::size_t c = 0; c < 4; ++c)
        corners[c] = static_cast<std::uint32_t>(facet[c] >= 0 ? facet[c] : n_moving - facet[c] - 1);
    }
    surface_.hidden /= 2;  // each was met from both sides
    return std::move(surface_);
  }

  const Body& body_;
  const Cells& cells_;
  CutCells cut_;
  Numbering numbering_;
  std::optional<double> threshold_;
  std::uint32_t rgba_;
  Surface surface_;
  std::vector<std::array<std::int64_t, 4>> facets_;
};

}  // namespace

Surface voxel_surface(const Body& body, const LiveElements& live, std::optional<double> threshold,
                      std::uint32_t rgba) {
  return Builder(body, live, threshold, rgba).build();
}

Surface make_surface(const Body& body, const LiveElements& live, std::optional<double> threshold,
                     std::uint32_t plain_rgba) {
  if (body.mesh) return mesh_surface(body, live, plain_rgba);
  if (body.cells) return voxel_surface(body, live, threshold, plain_rgba);
  return fcc_surface(body, live, plain_rgba);
}

Surface make_surface(const Topology& moving, std::optional<double> threshold, std::uint32_t plain_rgba) {
  return make_surface(moving.body(), LiveElements(moving), threshold, plain_rgba);
}

}  // namespace palpate::physics
