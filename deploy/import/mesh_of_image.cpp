#include "deploy/import/mesh_of_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/units.h"
#include "deploy/import/stuffing.h"
#include "deploy/import/tissue_field.h"
#include "physics_node/mesh/mesh_pinches.h"

namespace palpate {
namespace {

// Boxes that tissue is shared out to, in edges. Why: details that are smaller than a tetrahedron make bad ones of many.
constexpr double grain_in_edges = 0.5;
constexpr double most_points = 4e6;  // of the lattice: more tetrahedra than any machine steps
constexpr int most_shifts = 40;
constexpr int halvings = 12;            // of the level: to a four-thousandth
constexpr double level_range = 0.45;    // about a half
constexpr double volume_within = 1e-3;  // of the tissue's
constexpr double least_share = 0.5;     // of the tissue's volume that a mesh must fill

double volume_of(const physics::TetMesh& mesh) {
  double sum = 0;
  for (const auto& tet : mesh.tets) sum += signed_volume(mesh, tet);
  return sum;
}

/// Where the lattice lies in attempt n: points that are spread evenly (Roberts' R3), the first at the place as it is.
Vec3 shift_of(int n) {
  constexpr double g = 1.22074408460575947536;  // g^4 = g + 1
  Vec3 shift(n / g, n / (g * g), n / (g * g * g));
  for (double& part : shift) part -= std::floor(part);
  return shift;
}

/// As large as the tissue, or as near to it as levels go.
physics::TetMesh as_large_as(const TissueField& field, const StuffingLattice& lattice, double tissue) {
  double low = 0.5 - level_range, high = 0.5 + level_range, level = 0.5;
  physics::TetMesh best;
  double off = tissue;
  for (int n = 0; n < halvings; ++n) {
    physics::TetMesh mesh = stuff(lattice, [&](const Vec3& x) { return field.at(x) - level; });
    const double more = volume_of(mesh) - tissue;
    if (std::abs(more) < off || best.tets.empty()) off = std::abs(more), best = std::move(mesh);
    if (off < volume_within * tissue) break;
    (more > 0 ? low : high) = level;
    level = 0.5 * (low + high);
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
  for (; made.shifts < most_shifts; ++made.shifts) {
    lattice.shift = shift_of(made.shifts);
    made.mesh = as_large_as(field, lattice, field.tissue());
    pinches = pinches_of(made.mesh, outer_faces(made.mesh));
    made.filled = volume_of(made.mesh);
    if (made.filled < least_share * field.tissue()) continue;  // too coarse here
    if (!made.mesh.tets.empty() && pinches.none()) break;
  }
  if (made.mesh.tets.empty() || made.shifts == most_shifts)
    throw InputError(
        made.mesh.tets.empty() || pinches.none()
            ? fmt::format(
                  "{}: tetrahedra of {:g} mm are too coarse for this tissue; write a smaller --tetrahedra-mm",
                  where, mm)
            : fmt::format(
                  "{}: tissue thinner than a tetrahedron makes the surface touch itself at {:.1f}, {:.1f}, "
                  "{:.1f} mm from the image's corner; write a smaller --tetrahedra-mm than {:g}",
                  where, mm_from_m(pinches.where.x()), mm_from_m(pinches.where.y()),
                  mm_from_m(pinches.where.z()), mm));
  made.pieces = n_pieces_of(made.mesh);
  made.tissue = field.tissue();
  made.angles = dihedral_angles(made.mesh);
  return made;
}

}  // namespace palpate
