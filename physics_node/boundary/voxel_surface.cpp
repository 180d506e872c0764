#include <algorithm>
#include <unordered_map>

#include "physics_node/body/build_lattice.h"
#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/cut_lips.h"
#include "physics_node/boundary/smooth_skin.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/boundary/tissue_below.h"
#include "physics_node/boundary/voxel_facets.h"

namespace palpate::physics {
namespace {

/// Gives every vertex that a facet uses a number: those that move and points of the scenery apart.
class Numbering {
 public:
  Numbering(const Body& body, const LiveElements& live, const CutCells& cut, std::optional<double> threshold)
      : body_(body), live_(live), cut_(cut), shift_(lattice_corner(*body.cells, body.lattice)) {
    if (SmoothSkin::is_on(body)) skin_.emplace(body, threshold);
  }

  /// Number of a corner of a cell, negative for scenery: the sign is resolved when the count of moving ones is known.
  std::int64_t number(const Vec3i& corner, const Vec3i& cell, Surface& surface) {
    const Vec3i& n = body_.cells->size;
    const int fan = fan_of(corner, cell);
    constexpr int most_fans = 4;
    const Index mass = node_at(corner, cell);
    const bool is_copy = mass >= body_.lattice.n_cells();
    const std::int64_t key =
        is_copy
            ? -1 - (fan + 1 + (most_fans + 1LL) * mass)
            : fan + 1 +
                  (most_fans + 1) * (corner.x() + (n.x() + 1LL) * (corner.y() + (n.y() + 1LL) * corner.z()));
    const auto found = numbers_.find(key);
    if (found != numbers_.end()) return found->second;
    const Vec3 on_lattice =
        mass >= 0 ? body_.lattice.rest_position(body_.lattice.mass_at(corner - shift_))
                  : Vec3(body_.cells->corner + body_.cells->spacing.cwiseProduct(corner.cast<double>()));
    Vec3 rest = fan < 0 ? on_lattice : skin_->place(corner, fan);
    std::optional<CellsRound> round;
    if (skin_ && mass >= 0) round = cells_round(corner, mass);
    const CutLip lip = round ? lip_of(*round, body_.cells->spacing) : CutLip{};
    if (lip.n > 0) rest += fan < 0 ? lip.place : lip.from_skin(rest - on_lattice);
    std::int64_t value = 0;
    if (mass >= 0) {
      value = static_cast<std::int64_t>(surface.cell.size());
      surface.cell.push_back(mass);
      surface.rest.push_back(rest);
      at_lip_.push_back(lip.n > 0);
      if (skin_) add_bearers(corner, fan, mass, rest, round, surface);
    } else {
      scenery_.push_back(rest);
      value = -static_cast<std::int64_t>(scenery_.size());
    }
    numbers_.emplace(key, value);
    return value;
  }

  void make_room(std::size_t vertices, Surface& surface) {
    numbers_.reserve(vertices);
    at_lip_.reserve(vertices);
    surface.rest.reserve(vertices);
    surface.cell.reserve(vertices);
    if (!skin_) return;
    surface.bearers.reserve(vertices);
    surface.fan.reserve(vertices);
  }

  const std::vector<Vec3>& scenery() const { return scenery_; }
  bool is_smooth() const { return skin_.has_value(); }
  /// Is it a vertex of a smooth skin at a cut?
  bool is_at_lip(std::int64_t number) const {
    return number >= 0 && at_lip_[static_cast<std::size_t>(number)];
  }
  /// null: the cell is as loaded
  const LiveElements::PartedCell* parted(const Vec3i& cell) const {
    return live_.parted().empty() ? nullptr : live_.parted(storage_of(cell));
  }

 private:
  /// Where a cell broke, all facets at a corner share a vertex: the fans of before may have grown together.
  int fan_of(const Vec3i& corner, const Vec3i& cell) const {
    if (!skin_) return -1;
    const int fan = skin_->fan(corner, cell);
    if (fan <= 0 || !cut_.any()) return fan;
    for (unsigned o = 0; o < 8; ++o)
      if (cut_.is_cut(SmoothSkin::cell_at(corner, o))) return 0;
    return fan;
  }
  /// As the cell has it.
  Index node_at(const Vec3i& corner, const Vec3i& cell) const {
    const Index loaded = body_.lattice.mass_at(corner - shift_);
    const auto* of = loaded >= 0 ? parted(cell) : nullptr;
    return of == nullptr ? loaded : of->corners[corner_number(corner - cell)];
  }
  Index storage_of(const Vec3i& cell) const { return body_.lattice.mass_at(cell - shift_); }
  /// Round a node at a cut; none: all cells there are as loaded.
  std::optional<CellsRound> cells_round(const Vec3i& corner, Index node) const {
    CellsRound round;
    bool any = false;
    for (unsigned o = 0; o < 8 && !live_.parted().empty(); ++o) {
      const Vec3i cell = SmoothSkin::cell_at(corner, o);
      if (body_.cells->share_of(cell.x(), cell.y(), cell.z()) <= 0) continue;
      const auto* of = parted(cell);
      any = any || of != nullptr;
      round.corners[o] = of != nullptr ? of->corners : body_.cell_net()->loaded_corners(storage_of(cell));
      round.has[o] = round.corners[o][7 - o] == node;
      if (of != nullptr) round.cut_at[o] = of->cut_at;
    }
    return any ? std::optional(round) : std::nullopt;
  }
  void add_bearers(const Vec3i& corner, int fan, Index mass, const Vec3& rest,
                   const std::optional<CellsRound>& at_cut, Surface& surface) const {
    const auto alive = [this](const Vec3i& cell) { return !cut_.is_cut(cell); };
    const auto corners_at = [&at_cut](unsigned o) { return at_cut->corners_at(o); };
    surface.bearers.push_back(at_cut
                                  ? skin_->bearers_of_part(corner, std::max(fan, 0), rest, mass, corners_at)
                              : fan < 0 ? Bearers::alone(mass)
                                        : skin_->bearers(corner, fan, rest, alive));
    surface.fan.push_back(static_cast<std::uint8_t>(fan < 0 ? no_fan : fan));
  }

  const Body& body_;
  const LiveElements& live_;
  const CutCells& cut_;
  Vec3i shift_;
  std::optional<SmoothSkin> skin_;
  std::unordered_map<std::int64_t, std::int64_t> numbers_;
  std::vector<Vec3> scenery_;
  std::vector<bool> at_lip_;  // of vertices that move
};

/// Collects the facets of one body.
class Builder {
 public:
  Builder(const Body& body, const LiveElements& live, std::optional<double> threshold, std::uint32_t rgba)
      : cells_(*body.cells),
        cut_(body, live),
        numbering_(body, live, cut_, threshold),
        threshold_(cells_.intensity.empty() ? std::nullopt : threshold),
        is_whole_(!cut_.any() && live.parted().empty()),
        rgba_(rgba) {}

  Surface build() {
    const auto is_shown = [this](const Vec3i& cell) { return shown(cell); };
    const VoxelFacets facets(cut_, is_shown);
    mark_shown();
    make_room();
    for (int k = 0; k < cells_.size.z(); ++k)
      for (int j = 0; j < cells_.size.y(); ++j)
        for (int i = 0; i < cells_.size.x(); ++i) {
          const Vec3i cell(i, j, k);
          if (!shown(cell)) continue;
          if (is_buried(cell)) {
            count_hidden(6);
            continue;
          }
          for (const VoxelFace& face : voxel_faces) add_opened(cell, face);
          for (const VoxelFace& face : voxel_faces)
            count_hidden(facets.on_face(cell, face, [&](const FacetCorners& corners, bool) {
              add_facet(cell, corners, coloured_by(cell, face));
              if (covers()) skin_.push_back(facets_.size() - 1);
            }));
        }
    for (const Vec3i& cell : cut_.cells())
      if (shown(cell))
        count_hidden(
            facets.inside(cell, [&](const FacetCorners& corners, bool) { add_facet(cell, corners, cell); }));
    return finish();
  }

 private:
  void mark_shown() {
    if (!threshold_) return;
    over_threshold_.resize(cells_.filled.size());
    for (std::size_t n = 0; n < over_threshold_.size(); ++n)
      over_threshold_[n] =
          cells_.filled[n] != 0 && static_cast<double>(cells_.intensity[n]) >= *threshold_ ? 1 : 0;
  }
  /// About as many facets as there are faces between cells that are shown and cells that are not, and no more vertices.
  void make_room() {
    const auto& s = all_shown();
    const auto row = static_cast<std::size_t>(cells_.size.x());
    std::size_t ends = 0;  // of rows of shown cells along x and y; about half as many are along z
    for (std::size_t n = 0; n + row < s.size(); ++n) ends += (s[n] != s[n + row]) + (s[n] != s[n + 1]);
    const std::size_t facets = ends + ends / 2;
    facets_.reserve(facets);
    surface_.rgba.reserve(facets);
    surface_.site.reserve(facets);
    numbering_.make_room(facets, surface_);
  }
  const std::vector<std::uint8_t>& all_shown() const { return threshold_ ? over_threshold_ : cells_.filled; }
  bool shown(const Vec3i& c) const {
    return cells_.is_filled(c.x(), c.y(), c.z()) && all_shown()[cells_.index(c.x(), c.y(), c.z())] != 0;
  }
  /// Most cells of a scan are, and are not looked at face by face.
  bool is_buried(const Vec3i& c) const {
    if (!is_whole_ || (c.array() < 1).any() || (c.array() > cells_.size.array() - 2).any()) return false;
    const auto& s = all_shown();
    const auto row = static_cast<std::size_t>(cells_.size.x());
    const std::size_t n = cells_.index(c.x(), c.y(), c.z()),
                      plane = row * static_cast<std::size_t>(cells_.size.y());
    return (s[n - 1] & s[n + 1] & s[n - row] & s[n + row] & s[n - plane] & s[n + plane]) != 0;
  }
  double intensity(const Vec3i& cell) const {
    return static_cast<double>(cells_.intensity[cells_.index(cell.x(), cell.y(), cell.z())]);
  }
  /// A face that a cut has opened between two cells that are shown.
  void add_opened(const Vec3i& cell, const VoxelFace& face) {
    const auto* parted = numbering_.parted(cell);
    if (parted == nullptr || !cells_.is_deformable(cell.x(), cell.y(), cell.z())) return;
    if (!shown(cell + face.outward) || (parted->open >> (&face - voxel_faces.data()) & 1) == 0) return;
    std::array<Vec3i, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) corners[c] = cell + face.corners[c];
    add_facet(cell, corners, cell, true);
    surface_.hidden -= 1;  // on_face() counts it
  }
  bool is_lip(const std::array<std::int64_t, 4>& facet) const {
    return std::ranges::any_of(facet, [this](std::int64_t v) { return numbering_.is_at_lip(v); });
  }
  void count_hidden(int facets) { surface_.hidden += static_cast<std::uint64_t>(facets); }

  /// Is a skin drawn in the colour of what it covers?
  bool covers() const { return numbering_.is_smooth() && !cells_.transfer.empty(); }
  /// A smooth skin cuts through cells that are partly air, and has the colour of the tissue below them.
  Vec3i coloured_by(const Vec3i& cell, const VoxelFace& face) const {
    const Vec3i below = cell - face.outward;
    return numbering_.is_smooth() && shown(below) ? below : cell;
  }

  /// A cut shows, shut or open: its lips, and the skin beside them.
  void add_facet(const Vec3i& cell, const std::array<Vec3i, 4>& corners, const Vec3i& coloured,
                 bool is_lip = false) {
    auto& facet = facets_.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) facet[c] = numbering_.number(corners[c], cell, surface_);
    is_lip = is_lip || this->is_lip(facet);
    const std::uint32_t rgba =
        cells_.transfer.empty() ? rgba_ : rgba_of(cells_.transfer, intensity(coloured));
    surface_.rgba.push_back(is_lip ? inside_colour(rgba) : rgba);
    surface_.site.push_back(static_cast<std::uint32_t>(cells_.index(cell.x(), cell.y(), cell.z())));
  }

  /// Puts the scenery behind the moving vertices.
  Surface finish() {
    surface_.rest.insert(surface_.rest.end(), numbering_.scenery().begin(), numbering_.scenery().end());
    const auto n_moving = static_cast<std::int64_t>(surface_.cell.size());
    surface_.facets.reserve(facets_.size());
    for (const auto& facet : facets_) {
      auto& corners = surface_.facets.emplace_back();
      for (std::size_t c = 0; c < 4; ++c)
        corners[c] = static_cast<std::uint32_t>(facet[c] >= 0 ? facet[c] : n_moving - facet[c] - 1);
      if (numbering_.is_smooth()) turn_to_shorter(corners);
    }
    colour_skin();
    surface_.hidden /= 2;  // each was met from both sides
    return std::move(surface_);
  }

  /// By what lies everywhere equally deep below it. Why: a cell is air in part by where the skin goes through
  /// it or by it, and its colour would be drawn like the grain of wood.
  void colour_skin() {
    constexpr double deep = 1;  // in cells. Why: less is air in part; from more, bone shows through thin skin
    for (const std::size_t n : skin_) {
      if (is_lip(facets_[n])) continue;
      std::array<Vec3, 4> at;
      for (std::size_t c = 0; c < 4; ++c) at[c] = surface_.rest[surface_.facets[n][c]];
      const Vec3 area = (at[2] - at[0]).cross(at[3] - at[1]);
      if (!(area.norm() > 0)) continue;
      const auto below =
          intensity_below(cells_, (at[0] + at[1] + at[2] + at[3]) / 4, area.normalized(), deep, all_shown());
      if (below) surface_.rgba[n] = rgba_of(cells_.transfer, *below);
    }
  }

  /// A square that is not flat is drawn and felt as two triangles on either side of its corners 0 and 2: the nearer
  /// ones.
  void turn_to_shorter(std::array<std::uint32_t, 4>& c) const {
    const auto square = [&](std::size_t a, std::size_t b) {
      return (surface_.rest[c[a]] - surface_.rest[c[b]]).squaredNorm();
    };
    if (c[2] != c[3] && square(1, 3) < square(0, 2)) std::rotate(c.begin(), c.begin() + 1, c.end());
  }

  const Cells& cells_;
  CutCells cut_;
  Numbering numbering_;
  std::optional<double> threshold_;
  bool is_whole_;  // nothing has broken or been cut
  std::vector<std::uint8_t> over_threshold_;
  std::uint32_t rgba_;
  Surface surface_;
  std::vector<std::array<std::int64_t, 4>> facets_;
  std::vector<std::size_t> skin_;  // of these, those of a smooth skin over an image
};

}  // namespace

Surface voxel_surface(const Body& body, const LiveElements& live, std::optional<double> threshold,
                      std::uint32_t rgba) {
  return Builder(body, live, threshold, rgba).build();
}

Surface on_masses(const Body& body, Surface surface) {
  for (std::size_t v = 0; v < surface.n_moving(); ++v) surface.rest[v] = body.rest_position(surface.cell[v]);
  surface.bearers.clear();
  surface.fan.clear();
  return surface;
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
