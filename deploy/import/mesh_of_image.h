#pragma once
// A mesh of tetrahedra that fills the tissue of an image: as large as it, in one surface that nowhere touches itself.

#include <array>
#include <functional>
#include <vector>

#include "common/record/volume.h"
#include "physics_node/mesh/mesh_quality.h"
#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

/// What meshing takes at its worst moment: of a cell of the image, and of a point of the lattice.
inline constexpr double meshed_cell_bytes = 24, lattice_point_bytes = 2000;

struct ImageMeshOptions {
  double keep_min = 0, keep_max = 0;  // intensities that are tissue, both included
  double edge = 0;                    // of the cubes of the lattice; of its tetrahedra the longer ones [m]
  bool largest = false;               // only the largest part of each tissue
  std::vector<std::array<double, 2>> others =
      {};  // intensities of further tissues, which become regions 1, 2, ...
  /// Told how many points the lattice will have, before it is made; may throw.
  std::function<void(double points)> before_lattice = [](double) {};
};

struct RegionVolume {
  double tissue = 0, filled = 0;  // of its cells, of its tetrahedra [m^3]
};

struct ImageMesh {
  physics::TetMesh mesh;  // placed as TissueField says; region: which tissue, from 0 on [m]
  std::vector<RegionVolume> regions;
  physics::DihedralAngles angles;
  double tissue = 0, filled = 0;  // volumes: of the cells that are kept, of the tetrahedra [m^3]
  std::size_t pieces = 0;         // that do not hang together over faces
};

/// Several tissues are filled as one, which is then cut where one's share of a place is as large as another's, or nearly, as volumes want it: tetrahedra on both sides have the
/// same nodes there.
/// The level of the surface is chosen so that both volumes are the same, within limits: a mesh of chords would be smaller, but what is lost of
/// thin parts must not make thick ones larger.
/// @param where  begins complaints
/// @throws InputError: no tissue, a lattice too coarse for it, too many points, or a surface that touches itself wherever the lattice lies
ImageMesh mesh_of_image(const Volume& volume, const ImageMeshOptions& options, const std::string& where);

}  // namespace palpate
