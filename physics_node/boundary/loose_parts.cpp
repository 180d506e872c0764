#include "physics_node/boundary/loose_parts.h"

#include <algorithm>
#include <unordered_map>

#include "physics_node/body/build_lattice.h"

namespace palpate::physics {
namespace {

/// Two further directions that close a triangle over an element: one from each end to the third mass.
struct Apex {
  int from_first = 0, from_second = 0;
};

std::vector<std::vector<Apex>> apexes(LatticeKind kind) {
  const auto directions = all_directions(kind);
  std::vector<std::vector<Apex>> of(directions.size());
  for (std::size_t d = 0; d < directions.size(); ++d)
    for (std::size_t e = 0; e < directions.size(); ++e)
      for (std::size_t f = 0; f < directions.size(); ++f)
        if (directions[e] - directions[d] == directions[f])
          of[d].push_back({static_cast<int>(e), static_cast<int>(f)});
  return of;
}

/// The colour of what lies at a mass: of a cell round it that is shown. Nothing: none is.
std::optional<std::uint32_t> colour_at(const Body& body, Index mass, std::optional<double> threshold,
                                       std::uint32_t plain_rgba) {
  if (!body.cells || body.cells->intensity.empty()) return plain_rgba;
  const Cells& cells = *body.cells;
  const Vec3i at = lattice_corner(cells, body.lattice) + body.lattice.grid_of(mass);
  for (int n = 0; n < 8; ++n) {
    const Vec3i cell = at - Vec3i(n & 1, n >> 1 & 1, n >> 2);
    if (!cells.is_filled(cell.x(), cell.y(), cell.z())) continue;
    const auto intensity = static_cast<double>(cells.intensity[cells.index(cell.x(), cell.y(), cell.z())]);
    if (threshold && intensity < *threshold) continue;
    return cells.transfer.empty() ? plain_rgba : rgba_of(cells.transfer, intensity);
  }
  return std::nullopt;
}

/// Vertices for masses that the facets do not use yet.
class MoreVertices {
 public:
  MoreVertices(const Body& body, Surface& surface) : body_(body), surface_(surface) {
    for (std::size_t n = 0; n < surface.cell.size(); ++n)
      number_.emplace(surface.cell[n], static_cast<std::uint32_t>(n));
  }

  std::uint32_t number(Index mass) {
    const auto next = static_cast<std::uint32_t>(surface_.cell.size() + added_.size());
    const auto [at, is_new] = number_.try_emplace(mass, next);
    if (is_new) added_.push_back(mass);
    return at->second;
  }

  /// Puts them behind the moving vertices; scenery moves up.
  void insert() {
    const auto n_moving = static_cast<std::uint32_t>(surface_.cell.size());
    const auto n_added = static_cast<std::uint32_t>(added_.size());
    for (auto& facet : surface_.facets)
      for (auto& corner : facet) corner += corner >= n_moving ? n_added : 0;
    std::vector<Vec3> rest;
    for (const Index mass : added_) rest.push_back(body_.lattice.rest_position(mass));
    surface_.rest.insert(surface_.rest.begin() + n_moving, rest.begin(), rest.end());
    surface_.cell.insert(surface_.cell.end(), added_.begin(), added_.end());
    if (surface_.bearers.empty()) return;
    for (const Index mass : added_) surface_.bearers.push_back(Bearers::alone(mass));
    surface_.fan.resize(surface_.cell.size(), no_fan);
  }

 private:
  const Body& body_;
  Surface& surface_;
  std::unordered_map<Index, std::uint32_t> number_;
  std::vector<Index> added_;
};

}  // namespace

std::vector<LoosePart> loose_parts(const Body& body, const LiveElements& live) {
  const Lattice& lattice = body.lattice;
  const auto closing = apexes(lattice.kind);
  std::vector<LoosePart> parts;
  for (const Index mass : lattice.masses) {
    if (lattice.is_beyond(mass)) continue;
    const Mask mask = live.mask(mass);
    if ((mask & element_bits) == 0) parts.push_back({mass, mass});
    const auto kind = static_cast<std::size_t>(lattice.row_kind(mass));
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
      if ((mask >> d & 1) == 0) continue;
      const Index other = mass + lattice.offset[kind][d];
      const Mask of_other = live.mask(other);
      bool in_triangle = false;
      for (const Apex& apex : closing[d])
        in_triangle = in_triangle || (mask >> apex.from_first & of_other >> apex.from_second & 1) != 0;
      if (!in_triangle) parts.push_back({mass, other});
    }
  }
  return parts;
}

void add_loose_parts(const Body& body, const LiveElements& live, std::optional<double> threshold,
                     std::uint32_t plain_rgba, Surface& surface) {
  MoreVertices vertices(body, surface);
  std::vector<std::array<std::uint32_t, 4>> facets;
  for (const auto& [mass, other] : loose_parts(body, live)) {
    const auto rgba = colour_at(body, mass, threshold, plain_rgba);
    if (!rgba) continue;
    const std::uint32_t end = vertices.number(other);
    facets.push_back({vertices.number(mass), end, end, end});
    surface.rgba.push_back(*rgba);
  }
  vertices.insert();
  surface.facets.insert(surface.facets.end(), facets.begin(), facets.end());
}

std::size_t count_loose(const Surface& surface) {
  return static_cast<std::size_t>(std::count_if(surface.facets.begin(), surface.facets.end(), is_loose));
}

}  // namespace palpate::physics
