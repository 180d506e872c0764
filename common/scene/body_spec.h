#pragma once
// [[body]] of a scene: shape, place, materials of its parts, what is held.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/element_kinds.h"
#include "common/scene/kinds.h"
#include "common/scene/place.h"
#include "common/scene/shape_spec.h"

namespace palpate {

struct FixedBox {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // world [m]
};

/// A part of a body that is of another material, or empty: where the tissue rests, or how bright its
/// image is.
struct BoxRegion {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // world [m]
};
struct BallRegion {
  Vec3 center = Vec3::Zero();  // world [m]
  double radius = 0;           // [m]
};
/// Of a volume only.
struct IntensityRegion {
  double lo = 0, hi = 0;  // inclusive
};
/// Of a mesh only: the physical group that its file gives tetrahedra.
struct GroupRegion {
  int group = 0;
};
struct RegionSpec {
  std::string material;
  std::variant<BoxRegion, BallRegion, IntensityRegion, GroupRegion> where;
  Place place;
};

/// What a surface of springs is besides its material.
struct MembraneSpec {
  double thickness = 0;  // [m]
  double pressure =
      0;  // of what it is filled with, above what is outside, while its volume is that at rest [Pa]
  double content_modulus = 0;  // by which that rises as the volume falls; 0: it stays [Pa]
};

/// Material that is taken away from a shape.
struct CavitySpec {
  std::variant<BoxRegion, BallRegion> where;
  Place place;
};

/// Where the tissue of a body of cells ends.
struct BorderSpec {
  BorderCells cells = BorderCells::whole;  // of fem
  SkinKind skin = SkinKind::bricks;        // of voxels
};

struct BodySpec {
  std::string name;
  LatticeKind lattice = LatticeKind::fcc;
  ElementModel model = ElementModel::springs;
  HourglassKind hourglass = HourglassKind::physical;       // of fem
  TetElements tet_elements = TetElements::nodal_pressure;  // of a mesh
  std::optional<MembraneSpec> membrane;                    // of a surface
  StartKind start = StartKind::rest;                       // of fem
  BorderSpec border;
  std::optional<double> spacing;  // [m]; absent only for a volume of voxels and a mesh, which bring their own
  std::string material;
  std::vector<RegionSpec> regions;  // of other materials; later ones win
  std::vector<CavitySpec> cavities;
  Vec3 at = Vec3::Zero();  // centre of the shape, or tip of a knife or needle [m]
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  // R_WB about `at`, from theta_deg; fcc only
  Vec3 velocity = Vec3::Zero();                               // [m/s]
  std::array<bool, 6> fixed_faces{};   // -x +x -y +y -z +z in its own frame: masses on that face are held
  std::vector<FixedBox> fixed_boxes;   // masses inside are held
  std::array<bool, 6> handle_faces{};  // of a tool, in its own frame: masses on that face move with the hand
  Shape shape = BoxShape{};
  Place place;
};

/// Is the body, or a region of it, of this material?
bool has_material(const BodySpec& body, const std::string& material);

}  // namespace palpate
