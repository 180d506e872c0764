#include "physics_node/boundary/site_facets.h"

#include <algorithm>
#include <span>

#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/fcc_facets.h"
#include "physics_node/boundary/voxel_facets.h"

namespace palpate::physics {
namespace {

class VoxelSites final : public SiteFacets {
 public:
  explicit VoxelSites(const Topology& moving)
      : lattice_(moving.body().lattice),
        cells_(*moving.body().cells),
        net_(moving.body().cell_net()),
        now_(moving.body(), moving.adjacency().of_all()) {}

  std::size_t n_sites() const noexcept override { return cells_.filled.size(); }

  /// The eight cells at the mass, and those that share a face with one of them.
  std::size_t around(Index mass, std::span<std::uint32_t, most_around> sites) const noexcept override {
    const Vec3i at = lattice_.grid_of(net_ != nullptr ? net_->origin(mass) : mass) + now_.shift();
    std::size_t n = 0;
    for (int z = -2; z <= 1; ++z)
      for (int y = -2; y <= 1; ++y)
        for (int x = -2; x <= 1; ++x) {
          const int beyond =
              (x == -2 || x == 1 ? 1 : 0) + (y == -2 || y == 1 ? 1 : 0) + (z == -2 || z == 1 ? 1 : 0);
          const Vec3i cell = at + Vec3i(x, y, z);
          if (beyond <= 1 && cells_.is_filled(cell.x(), cell.y(), cell.z())) sites[n++] = number(cell);
        }
    return n;
  }

  std::size_t facets_of(std::uint32_t site, std::span<Corners, most_facets> out) const noexcept override {
    const Vec3i cell = cells_.cell_of(site);
    const bool rigid = !is_deformable(cell);
    if (net_ != nullptr && !rigid) return facets_of_parted(cell, out);
    std::size_t n = 0;
    const auto take = [&](const FacetCorners& corners, bool bounds) {
      if (!bounds || n == out.size()) return;
      Corners masses;
      for (std::size_t c = 0; c < 4; ++c) masses[c] = now_.mass(corners[c]);
      if (std::all_of(masses.begin(), masses.end(), [](Index mass) { return mass >= 0; })) out[n++] = masses;
    };
    const auto shown = [this](const Vec3i& c) { return cells_.is_filled(c.x(), c.y(), c.z()); };
    const CellAndNeighbours cut(now_, cell);
    const VoxelFacets facets(cut, shown);
    for (const VoxelFace& face : voxel_faces)
      if (!rigid || is_deformable(cell + face.outward)) facets.on_face(cell, face, take);
    if (cut.is_cut(cell)) facets.inside(cell, take);
    return n;
  }

  Corners across(std::uint32_t site, const Corners& masses) const noexcept override {
    const Index lowest = net_ != nullptr ? now_.mass(cells_.cell_of(site)) : -1;
    if (lowest < 0 || !net_->has_cell(lowest)) return SiteFacets::across(site, masses);
    const CellNet::Corners mine = net_->corners(lowest);
    for (std::size_t f = 0; f < voxel_faces.size(); ++f) {
      std::array<std::size_t, 4> k{};
      bool same = true;
      for (std::size_t c = 0; c < 4; ++c) {
        k[c] = corner_number(voxel_faces[f].corners[c]);
        same = same && mine[k[c]] == masses[c];
      }
      if (!same || net_->beyond(lowest, f) == CellNet::none) continue;
      const CellNet::Corners theirs = net_->corners(net_->beyond(lowest, f));
      const std::size_t axis = std::size_t{1} << f / 2;
      return {theirs[k[0] ^ axis], theirs[k[1] ^ axis], theirs[k[2] ^ axis], theirs[k[3] ^ axis]};
    }
    return SiteFacets::across(site, masses);
  }

  bool is_rigid(std::uint32_t site) const noexcept override { return !is_deformable(cells_.cell_of(site)); }

 private:
  /// Of a cell that a cut may part from others: its faces with nothing behind them, with its own nodes at their corners.
  std::size_t facets_of_parted(const Vec3i& cell, std::span<Corners, most_facets> out) const noexcept {
    const Index lowest = now_.mass(cell);
    std::size_t n = 0;
    if (lowest < 0 || !net_->has_cell(lowest)) return n;
    const CellNet::Corners corners = net_->corners(lowest);
    for (std::size_t f = 0; f < voxel_faces.size(); ++f) {
      const VoxelFace& face = voxel_faces[f];
      const Vec3i beyond = cell + face.outward;
      const bool covered = cells_.is_filled(beyond.x(), beyond.y(), beyond.z());
      if (covered && (!is_deformable(beyond) || !net_->is_exposed(lowest, f))) continue;
      for (std::size_t c = 0; c < 4; ++c) out[n][c] = corners[corner_number(face.corners[c])];
      ++n;
    }
    return n;
  }
  bool is_deformable(const Vec3i& c) const noexcept { return cells_.is_deformable(c.x(), c.y(), c.z()); }
  std::uint32_t number(const Vec3i& c) const noexcept {
    return static_cast<std::uint32_t>(cells_.index(c.x(), c.y(), c.z()));
  }
  const Lattice& lattice_;
  const Cells& cells_;
  const CellNet* net_;  // of finite elements that may be cut; else null
  CellsNow now_;
};

class FccSites final : public SiteFacets {
 public:
  explicit FccSites(const Topology& moving)
      : lattice_(moving.body().lattice), net_(lattice_, moving.adjacency().of_all()), numbers_(lattice_) {}

  std::size_t n_sites() const noexcept override { return numbers_.size(); }

  /// The six octahedra at the mass, and the eight on whose faces it is the tip of a tetrahedron.
  std::size_t around(Index mass, std::span<std::uint32_t, most_around> sites) const noexcept override {
    const Vec3i at = lattice_.grid_of(mass);
    std::size_t n = 0;
    const auto add = [&](const Vec3i& site) {
      if (numbers_.inside(site)) sites[n++] = numbers_.number(site);
    };
    for (int a = 0; a < 3; ++a)
      for (const int sign : {-1, 1}) add(at + along_axis(a, sign));
    for (int octant = 0; octant < 8; ++octant)
      add(at + Vec3i(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1));
    return n;
  }

  std::size_t facets_of(std::uint32_t site, std::span<Corners, most_facets> out) const noexcept override {
    std::size_t n = 0;
    facets_of_site(net_, numbers_.site(site), [&](const SiteCorners& corners, bool bounds) {
      if (!bounds || n == out.size()) return;
      for (std::size_t c = 0; c < 4; ++c) out[n][c] = net_.mass(corners[c]);
      ++n;
    });
    return n;
  }

  bool is_rigid(std::uint32_t) const noexcept override { return false; }

 private:
  const Lattice& lattice_;
  LiveNet net_;
  SiteNumbers numbers_;
};

/// The elements of a mesh that may be cut.
template <class Net>
class NetSites : public SiteFacets {
 public:
  explicit NetSites(const Net& net) : net_(net) {}

  std::size_t n_sites() const noexcept override { return static_cast<std::size_t>(net_.n_elements()); }

  std::size_t around(Index mass, std::span<std::uint32_t, most_around> sites) const noexcept override {
    std::size_t n = 0;
    net_.each_around(mass,
                     [&](Index element, std::size_t) { sites[n++] = static_cast<std::uint32_t>(element); });
    return n;
  }

  bool is_rigid(std::uint32_t) const noexcept override { return false; }

 protected:
  const Net& net_;
};

class MeshSites final : public NetSites<TetNet> {
 public:
  using NetSites::NetSites;

  std::size_t facets_of(std::uint32_t site, std::span<Corners, most_facets> out) const noexcept override {
    std::size_t n = 0;
    for (std::size_t f = 0; f < 4; ++f) {
      if (!net_.is_exposed(static_cast<Index>(site), f)) continue;
      const MeshTriangle face = net_.face(static_cast<Index>(site), f);
      out[n++] = {face[0], face[1], face[2], face[2]};
    }
    return n;
  }

  Corners across(std::uint32_t site, const Corners& masses) const noexcept override {
    const auto tet = static_cast<Index>(site);
    for (std::size_t f = 0; f < 4; ++f) {
      const MeshTriangle mine = net_.face(tet, f);
      const Index other = net_.beyond(tet, f);
      if (other == TetNet::none || !std::ranges::equal(mine, std::span(masses).first(3))) continue;
      Corners theirs{-1, -1, -1, -1};
      for (std::size_t c = 0; c < 3; ++c)
        for (const Index node : net_.corners(other))
          if (net_.origin(node) == net_.origin(mine[c])) theirs[c] = node;
      theirs[3] = theirs[2];
      return theirs;
    }
    return SiteFacets::across(site, masses);
  }
};

/// The triangles of a surface, none of which ever goes: those at a cut have other corners than before.
class SurfaceSites final : public NetSites<TriangleNet> {
 public:
  using NetSites::NetSites;

  std::size_t facets_of(std::uint32_t site, std::span<Corners, most_facets> out) const noexcept override {
    const MeshTriangle& of = net_.corners(static_cast<Index>(site));
    out[0] = {of[0], of[1], of[2], of[2]};
    return 1;
  }
};

}  // namespace

std::unique_ptr<SiteFacets> make_site_facets(const Topology& moving) {
  const auto& mesh = moving.body().mesh;
  if (mesh && mesh->triangles) return std::make_unique<SurfaceSites>(*mesh->triangles);
  if (mesh) return std::make_unique<MeshSites>(*mesh->net);
  if (moving.body().cells) return std::make_unique<VoxelSites>(moving);
  return std::make_unique<FccSites>(moving);
}

}  // namespace palpate::physics
