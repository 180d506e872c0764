#include <unordered_map>

#include "physics_node/body/build_lattice.h"
#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {
namespace {

struct Face {
  Vec3i outward;
  std::array<Vec3i, 4> corners;  // of the unit cell, anticlockwise from outside
};

const std::array<Face, 6> faces{{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
    {{1, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
    {{0, 1, 0}, {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}}},
    {{0, 0, -1}, {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
}};

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
    for (int k = 0; k < cells_.size.z(); ++k)
      for (int j = 0; j < cells_.size.y(); ++j)
        for (int i = 0; i < cells_.size.x(); ++i) {
          if (!shown({i, j, k})) continue;
          for (const Face& face : faces) add_face({i, j, k}, face);
        }
    for (const Vec3i& cell : cut_.cells())
      if (shown(cell)) add_inside(cell);
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

  void add_face(const Vec3i& cell, const Face& face) {
    const Vec3i beyond = cell + face.outward;
    const bool covered = shown(beyond);
    if (cut_.is_cut(cell) || cut_.is_cut(beyond)) return add_cut_face(cell, face, covered);
    if (covered) {
      ++surface_.hidden;
      return;
    }
    add_facet(cell, {cell + face.corners[0], cell + face.corners[1], cell + face.corners[2],
                     cell + face.corners[3]});
  }

  /// The two triangles of a face between tetrahedra at its odd corners.
  void add_cut_face(const Vec3i& cell, const Face& face, bool covered) {
    const Vec3i beyond = cell + face.outward;
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3i odd = cell + face.corners[n];
      if (!cut_.is_odd(odd)) continue;
      const Vec3i before = cell + face.corners[(n + 3) % 4];
      const Vec3i after = cell + face.corners[(n + 1) % 4];
      const bool mine = !cut_.is_cut(cell) || cut_.corner_filled(cell, odd);
      const bool theirs = covered && (!cut_.is_cut(beyond) || cut_.corner_filled(beyond, odd));
      if (mine && theirs) {
        ++surface_.hidden;
      } else if (mine) {
        add_facet(cell, {before, odd, after, after});
      } else if (!theirs && cut_.is_triangle(before, odd, after) && (!covered || face.outward.sum() > 0)) {
        add_facet(cell, {before, odd, after, after});  // a sheet, shown by one of the two cells
      }
    }
  }

  /// The triangles between the middle tetrahedron and those at the corners.
  void add_inside(const Vec3i& cell) {
    const bool middle = cut_.middle_filled(cell);
    for (int n = 0; n < 8; ++n) {
      const Vec3i offset(n & 1, n >> 1 & 1, n >> 2 & 1);
      const Vec3i odd = cell + offset;
      if (!cut_.is_odd(odd)) continue;
      const Vec3i inwards = Vec3i::Ones() - 2 * offset;
      std::array<Vec3i, 3> p{odd, odd, odd};
      for (int a = 0; a < 3; ++a) p[static_cast<std::size_t>(a)][a] += inwards[a];
      const bool corner = cut_.corner_filled(cell, odd);
      if (corner && middle) {
        surface_.hidden += 2;
        continue;
      }
      if (!cut_.is_triangle(p[0], p[1], p[2])) continue;
      // x, y, z are anticlockwise seen from the inside of the cell when the product of signs is positive.
      if ((inwards.prod() > 0) == middle) std::swap(p[0], p[1]);
      add_facet(cell, {p[0], p[1], p[2], p[2]});
    }
  }

  void add_facet(const Vec3i& cell, const std::array<Vec3i, 4>& corners) {
    auto& facet = facets_.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) facet[c] = numbering_.number(corners[c], surface_);
    surface_.rgba.push_back(cells_.transfer.empty() ? rgba_ : rgba_of(cells_.transfer, intensity(cell)));
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
  if (body.cells) return voxel_surface(body, live, threshold, plain_rgba);
  return fcc_surface(body, live, plain_rgba);
}

Surface make_surface(const Topology& moving, std::optional<double> threshold, std::uint32_t plain_rgba) {
  return make_surface(moving.body(), LiveElements(moving), threshold, plain_rgba);
}

}  // namespace palpate::physics
