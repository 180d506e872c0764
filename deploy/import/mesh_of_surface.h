#pragma once
// A mesh of tetrahedra that fills a closed surface: its outer nodes lie on it.

#include <functional>
#include <string>

#include "deploy/import/closed_surface.h"
#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

struct SurfaceMeshOptions {
  double edge = 0;  // of the cubes of the lattice; of its tetrahedra the longer ones [m]
  /// Told how many points the lattice will have, before it is made; may throw.
  std::function<void(double points)> before_lattice = [](double) {};
};

struct SurfaceMesh {
  physics::TetMesh mesh;   // where the surface is [m]
  double filled = 0;       // volume of the tetrahedra [m^3]
  std::size_t pieces = 0;  // that do not hang together over faces
};

/// What the surface goes round once or more is inside: where it cuts through itself, that counts once.
/// @param where  begins complaints
/// @throws InputError: a lattice too coarse for it, too many points, or a mesh that touches itself wherever the lattice lies
SurfaceMesh mesh_of_surface(const ClosedSurface& closed, const SurfaceMeshOptions& options,
                            const std::string& where);

}  // namespace palpate
