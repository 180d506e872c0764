#include <unordered_map>

#include "physics_node/body/build_lattice.h"
#include "physics_node/surface/surface.h"

namespace palpate::physics {
namespace {

constexpr std::uint32_t plain_tissue = 0xFF8FA8E0;  // a body without an image

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

}  // namespace

Surface voxel_surface(const Body& body, std::optional<double> threshold) {
  const Cells& cells = *body.cells;
  const bool by_intensity = threshold.has_value() && !cells.intensity.empty();
  const auto shown = [&](int i, int j, int k) {
    if (!cells.is_filled(i, j, k)) return false;
    return !by_intensity || static_cast<double>(cells.intensity[cells.index(i, j, k)]) >= *threshold;
  };

  Surface surface;
  Numbering numbering(body);
  std::vector<std::array<std::int64_t, 4>> facets;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        if (!shown(i, j, k)) continue;
        for (const Face& face : faces) {
          if (shown(i + face.outward.x(), j + face.outward.y(), k + face.outward.z())) {
            ++surface.hidden;
            continue;
          }
          auto& facet = facets.emplace_back();
          for (std::size_t c = 0; c < 4; ++c)
            facet[c] = numbering.number(Vec3i(i, j, k) + face.corners[c], surface);
          surface.rgba.push_back(
              cells.transfer.empty()
                  ? plain_tissue
                  : rgba_of(cells.transfer, static_cast<double>(cells.intensity[cells.index(i, j, k)])));
        }
      }

  for (const Index cell : surface.cell) surface.rest.push_back(body.lattice.rest_position(cell));
  surface.rest.insert(surface.rest.end(), numbering.scenery().begin(), numbering.scenery().end());
  const auto n_moving = static_cast<std::int64_t>(surface.cell.size());
  surface.facets.reserve(facets.size());
  for (const auto& facet : facets) {
    auto& corners = surface.facets.emplace_back();
    for (std::size_t c = 0; c < 4; ++c)
      corners[c] = static_cast<std::uint32_t>(facet[c] >= 0 ? facet[c] : n_moving - facet[c] - 1);
  }
  surface.hidden /= 2;
  return surface;
}

Surface make_surface(const MovingBody& moving, std::optional<double> threshold, std::uint32_t plain_rgba) {
  if (moving.body().cells) return voxel_surface(moving.body(), threshold);
  return fcc_surface(moving.body(), moving, plain_rgba);
}

}  // namespace palpate::physics
