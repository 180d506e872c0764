#include "deploy/import/mesh_of_image.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"
#include "deploy/import/fill_box.h"
#include "deploy/import/tissue_field.h"

namespace palpate {
namespace {

// Boxes that tissue is shared out to, in edges. Why: details that are smaller than a tetrahedron make bad ones of many.
constexpr double grain_in_edges = 0.5;
constexpr int halvings = 10;                             // of the level
constexpr double middle_level = 0.5, level_range = 0.2;  // about a half
constexpr double volume_within = 1e-3;                   // of the tissue's

/// As large as the tissue, or as near to it as levels go. @param best  at the middle level
physics::TetMesh as_large_as(const TissueField& field, const StuffingLattice& lattice,
                             physics::TetMesh best) {
  double low = middle_level - level_range, high = middle_level + level_range, level = middle_level;
  double more = volume_of(best) - field.tissue(), off = std::abs(more);
  for (int n = 1; n < halvings && off >= volume_within * field.tissue(); ++n) {
    (more > 0 ? low : high) = level;
    level = 0.5 * (low + high);
    physics::TetMesh mesh = stuff(lattice, [&](const Vec3& x) { return field.at(x) - level; });
    more = volume_of(mesh) - field.tissue();
    if (std::abs(more) < off) off = std::abs(more), best = std::move(mesh);
  }
  return best;
}

}  // namespace

ImageMesh mesh_of_image(const Volume& volume, const ImageMeshOptions& options, const std::string& where) {
  const TissueField field(volume, options.keep_min, options.keep_max, options.largest,
                          grain_in_edges * options.edge);
  if (field.tissue() <= 0)
    throw InputError(
        fmt::format("{}: no cell has an intensity from {:g} to {:g}, so there is nothing to mesh; name "
                    "others with --keep",
                    where, options.keep_min, options.keep_max));
  StuffingLattice lattice{.low = field.low(), .high = field.high(), .edge = options.edge};
  check_points(lattice, where);
  options.before_lattice(points_of(lattice));
  // Levels are many, so each place of the lattice is looked at with one first.
  FilledBox box = fill_box(
      lattice,
      [&](const StuffingLattice& at) {
        return stuff(at, [&](const Vec3& x) { return field.at(x) - middle_level; });
      },
      [&](const StuffingLattice& at, physics::TetMesh mesh) {
        return as_large_as(field, at, std::move(mesh));
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
  check_filled(made.filled, field.tissue(), options.edge, "tissue", where);
  made.pieces = n_pieces_of(made.mesh);
  made.tissue = field.tissue();
  made.angles = dihedral_angles(made.mesh);
  return made;
}

}  // namespace palpate
