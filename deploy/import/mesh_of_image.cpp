#include "deploy/import/mesh_of_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"
#include "deploy/import/fill_box.h"
#include "deploy/import/split_mesh.h"
#include "deploy/import/tissue_field.h"

namespace palpate {
namespace {

// Boxes that tissue is shared out to, in edges. Why: details that are smaller than a tetrahedron make bad ones of many.
constexpr double grain_in_edges = 0.5;
constexpr int halvings = 10;                             // of the level
constexpr double lead_range = 0.4;                       // of a tissue's share before another's
constexpr double middle_level = 0.5, level_range = 0.2;  // about a half
constexpr double volume_within = 1e-3;                   // of the tissue's

/// Share of all tissues at a place, and what they measure together.
struct Tissues {
  std::vector<TissueField> fields;  // of each

  double at(const Vec3& x) const {
    double sum = 0;
    for (const TissueField& field : fields) sum += field.at(x);
    return sum;
  }
  /// How much more there is of one tissue than of any after it.
  double lead(std::size_t tissue, const Vec3& x) const {
    double other = 0;
    for (std::size_t n = tissue + 1; n < fields.size(); ++n) other = std::max(other, fields[n].at(x));
    return fields[tissue].at(x) - other;
  }
  double volume() const {
    double sum = 0;
    for (const TissueField& field : fields) sum += field.tissue();
    return sum;
  }
};

/// As large as the tissue, or as near to it as levels go. @param best  at the middle level
physics::TetMesh as_large_as(const Tissues& field, const StuffingLattice& lattice, physics::TetMesh best) {
  const double volume = field.volume();
  double low = middle_level - level_range, high = middle_level + level_range, level = middle_level;
  double more = volume_of(best) - volume, off = std::abs(more);
  for (int n = 1; n < halvings && off >= volume_within * volume; ++n) {
    (more > 0 ? low : high) = level;
    level = 0.5 * (low + high);
    physics::TetMesh mesh = stuff(lattice, [&](const Vec3& x) { return field.at(x) - level; });
    more = volume_of(mesh) - volume;
    if (std::abs(more) < off) off = std::abs(more), best = std::move(mesh);
  }
  return best;
}

/// Cuts one tissue off those after it, at the level that gives the smaller of both the volume of its cells, or as near to it as levels go.
void part_tissue(const Tissues& tissues, std::size_t tissue, physics::TetMesh& mesh) {
  const int own = static_cast<int>(tissue);
  const double wanted = tissues.fields[tissue].tissue();
  double wanted_rest = 0;
  for (std::size_t n = tissue + 1; n < tissues.fields.size(); ++n) wanted_rest += tissues.fields[n].tissue();
  const physics::TetMesh whole = std::move(mesh);
  double low = -lead_range, high = lead_range, level = 0, least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < halvings && least >= volume_within * std::min(wanted, wanted_rest); ++n) {
    physics::TetMesh parted = whole;
    const SplitMesh split =
        split_mesh(parted, [&](const Vec3& x) { return tissues.lead(tissue, x) - level; });
    double above = 0, below = 0;
    for (std::size_t t = 0; t < parted.tets.size(); ++t) {
      if (parted.region[t] != own) continue;
      (split.above[t] ? above : below) += signed_volume(parted, parted.tets[t]);
      if (!split.above[t]) parted.region[t] = own + 1;
    }
    const double more = wanted < wanted_rest ? above - wanted : wanted_rest - below;  // of this tissue
    if (std::abs(more) < least) least = std::abs(more), mesh = std::move(parted);
    (more > 0 ? low : high) = level;
    level = 0.5 * (low + high);
  }
}

/// @throws InputError: a region that misses its tissue
std::vector<RegionVolume> volumes_of_regions(const Tissues& tissues, const physics::TetMesh& mesh,
                                             double edge, const std::string& where) {
  std::vector<RegionVolume> volumes;
  for (const TissueField& field : tissues.fields) volumes.push_back({.tissue = field.tissue()});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    volumes[static_cast<std::size_t>(mesh.region[t])].filled += signed_volume(mesh, mesh.tets[t]);
  if (volumes.size() > 1)
    for (std::size_t n = 0; n < volumes.size(); ++n)
      check_filled(volumes[n].filled, volumes[n].tissue, edge, fmt::format("the tissue of region {}", n),
                   where);
  return volumes;
}

}  // namespace

ImageMesh mesh_of_image(const Volume& volume, const ImageMeshOptions& options, const std::string& where) {
  std::vector<std::array<double, 2>> keep = options.others;
  keep.insert(keep.begin(), {options.keep_min, options.keep_max});
  Tissues tissues;
  Eigen::AlignedBox3d box_of_all;
  for (const auto& [lowest, highest] : keep) {
    const TissueField& field =
        tissues.fields.emplace_back(volume, lowest, highest, options.largest, grain_in_edges * options.edge);
    if (field.tissue() <= 0)
      throw InputError(
          fmt::format("{}: no cell has an intensity from {:g} to {:g}, so there is nothing to mesh; name "
                      "others with --keep",
                      where, lowest, highest));
    box_of_all.extend(field.low());
    box_of_all.extend(field.high());
  }
  const StuffingLattice lattice{.low = box_of_all.min(), .high = box_of_all.max(), .edge = options.edge};
  check_points(lattice, where);
  options.before_lattice(points_of(lattice));
  // Levels are many, so each place of the lattice is looked at with one first.
  FilledBox box = fill_box(
      lattice,
      [&](const StuffingLattice& at) {
        return stuff(at, [&](const Vec3& x) { return tissues.at(x) - middle_level; });
      },
      [&](const StuffingLattice& at, physics::TetMesh mesh) {
        return as_large_as(tissues, at, std::move(mesh));
      });
  if (!box.pinches.none())
    throw InputError(fmt::format(
        "{}: tissue thinner than a tetrahedron makes the surface touch itself at {:.1f}, {:.1f}, {:.1f} mm "
        "from the "
        "image's corner; write a smaller --tetrahedra-mm than {:g}, or smooth the image",
        where, mm_from_m(box.pinches.where.x()), mm_from_m(box.pinches.where.y()),
        mm_from_m(box.pinches.where.z()), mm_from_m(options.edge)));
  ImageMesh made;
  made.mesh = std::move(box.mesh);
  made.filled = volume_of(made.mesh);
  made.tissue = tissues.volume();
  check_filled(made.filled, made.tissue, options.edge, "this tissue", where);
  for (std::size_t n = 0; n + 1 < tissues.fields.size(); ++n) part_tissue(tissues, n, made.mesh);
  made.regions = volumes_of_regions(tissues, made.mesh, options.edge, where);
  made.pieces = n_pieces_of(made.mesh);
  made.angles = dihedral_angles(made.mesh);
  return made;
}

}  // namespace palpate
