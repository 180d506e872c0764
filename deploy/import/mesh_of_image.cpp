#include "deploy/import/mesh_of_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"
#include "deploy/import/stuffing.h"
#include "deploy/import/tissue_field.h"
#include "physics_node/mesh/mesh_pinches.h"

namespace palpate {
namespace {

// Boxes that tissue is shared out to, in edges. Why: details that are smaller than a tetrahedron make bad ones of many.
constexpr double grain_in_edges = 0.5;
constexpr double most_points = 2e6;  // of the lattice: more tetrahedra than any machine steps
constexpr int most_shifts = 20;
// Tissue that is full of thin places has pinches wherever the lattice lies: that is known after a few.
constexpr int enough_shifts = 4;
constexpr std::size_t few_pinches = 4;
constexpr int halvings = 10;                             // of the level
constexpr double middle_level = 0.5, level_range = 0.2;  // about a half
constexpr double volume_within = 1e-3;                   // of the tissue's
constexpr double most_off = 0.1;                         // of the volume, from the tissue's

/// Where the lattice lies in attempt n: points that are spread evenly (Roberts' R3), the first at the place as it is.
Vec3 shift_of(int n) {
  constexpr double g = 1.22074408460575947536;  // g^4 = g + 1
  Vec3 shift(n / g, n / (g * g), n / (g * g * g));
  for (double& part : shift) part -= std::floor(part);
  return shift;
}

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
  const double mm = mm_from_m(options.edge);
  const TissueField field(volume, options.keep_min, options.keep_max, options.largest,
                          grain_in_edges * options.edge);
  if (field.tissue() <= 0)
    throw InputError(
        fmt::format("{}: no cell has an intensity from {:g} to {:g}, so there is nothing to mesh; name "
                    "others with --keep",
                    where, options.keep_min, options.keep_max));
  StuffingLattice lattice{.low = field.low(), .high = field.high(), .edge = options.edge};
  if (points_of(lattice) > most_points)
    throw InputError(
        fmt::format("{}: tetrahedra of {:g} mm in a box of {:.0f} x {:.0f} x {:.0f} mm are too many; write "
                    "--tetrahedra-mm {:.2g} or more",
                    where, mm, mm_from_m((field.high() - field.low()).x()),
                    mm_from_m((field.high() - field.low()).y()), mm_from_m((field.high() - field.low()).z()),
                    1.05 * mm * std::cbrt(points_of(lattice) / most_points)));
  options.before_lattice(points_of(lattice));
  ImageMesh made;
  physics::Pinches pinches;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  bool found = false;
  for (int n = 0; !found && n < most_shifts; ++n) {
    if (n == enough_shifts && fewest > few_pinches) break;
    lattice.shift = shift_of(n);
    const auto pinched = [&](const physics::TetMesh& mesh) {
      pinches = pinches_of(mesh, outer_faces(mesh));
      fewest = std::min(fewest, pinches.edges + pinches.nodes);
      return !pinches.none();
    };
    // Levels are many, so this place of the lattice is looked at with one first.
    made.mesh = stuff(lattice, [&](const Vec3& x) { return field.at(x) - middle_level; });
    if (pinched(made.mesh)) continue;
    made.mesh = as_large_as(field, lattice, std::move(made.mesh));
    found = !made.mesh.tets.empty() && !pinched(made.mesh);
  }
  made.filled = volume_of(made.mesh);
  if (!found && !pinches.none())
    throw InputError(fmt::format(
        "{}: tissue thinner than a tetrahedron makes the surface touch itself at {:.1f}, {:.1f}, {:.1f} mm "
        "from the "
        "image's corner; write a smaller --tetrahedra-mm than {:g}, or smooth the image",
        where, mm_from_m(pinches.where.x()), mm_from_m(pinches.where.y()), mm_from_m(pinches.where.z()), mm));
  if (!found || std::abs(made.filled / field.tissue() - 1) > most_off)
    throw InputError(
        fmt::format("{}: tetrahedra of {:g} mm are too coarse for this tissue: they fill {:.3g} cm3 of its "
                    "{:.3g}; write a smaller "
                    "--tetrahedra-mm",
                    where, mm, 1e6 * made.filled, 1e6 * field.tissue()));
  made.pieces = n_pieces_of(made.mesh);
  made.tissue = field.tissue();
  made.angles = dihedral_angles(made.mesh);
  return made;
}

}  // namespace palpate
