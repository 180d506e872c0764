#include "deploy/import/mesh_of_surface.h"

#include <fmt/format.h>

#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"
#include "deploy/import/fill_box.h"
#include "deploy/import/surface_winding.h"

namespace palpate {

SurfaceMesh mesh_of_surface(const ClosedSurface& closed, const SurfaceMeshOptions& options,
                            const std::string& where) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : closed.surface.points) box.extend(x);
  const StuffingLattice lattice{.low = box.min(), .high = box.max(), .edge = options.edge};
  check_points(lattice, where);
  options.before_lattice(points_of(lattice));
  const SurfaceWinding winding(closed.surface);
  const auto inside = [&](const Vec3& x) { return box.contains(x) && winding.at(x) > 0 ? 1.0 : -1.0; };
  FilledBox filled = fill_box(
      lattice, [&](const StuffingLattice& at) { return stuff(at, inside); },
      [](const StuffingLattice&, physics::TetMesh mesh) { return mesh; });
  if (!filled.pinches.none())
    throw InputError(
        fmt::format("{}: what is thinner than a tetrahedron makes the mesh touch itself at {:.1f}, {:.1f}, "
                    "{:.1f} mm; write a "
                    "smaller --tetrahedra-mm than {:g}",
                    where, mm_from_m(filled.pinches.where.x()), mm_from_m(filled.pinches.where.y()),
                    mm_from_m(filled.pinches.where.z()), mm_from_m(options.edge)));
  SurfaceMesh made;
  made.mesh = std::move(filled.mesh);
  made.filled = volume_of(made.mesh);
  check_filled(made.filled, closed.volume, options.edge, "this surface", where);
  made.pieces = n_pieces_of(made.mesh);
  return made;
}

}  // namespace palpate
