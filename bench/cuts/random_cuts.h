#pragma once
// A soft block and strokes of a scalpel through it that no surgeon would make: across, along, turned, to and fro, exactly through nodes,
// out of the block and back. The same seed gives the same on every machine.

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/scene.h"

namespace palpate::bench {

enum class CutKind {
  tetrahedra,  // a jittered mesh, free
  cells,       // of a voxel lattice, free
  springs,     // on either lattice, free
  parts,       // cells of an image that is awake in parts
  surfaces     // a bag of springs, filled or not
};
const std::vector<std::string>& cut_kinds();  // in that order

struct BladePose {
  Vec3 tip = Vec3::Zero();  // [m]
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  bool engaged = false;
};

struct RandomCuts {
  Scene scene;
  std::vector<BladePose>
      path;  // a pose a frame; strokes are apart from each other by poses that are not engaged
  int strokes = 0;
  double toughness = 0, modulus = 0, edge = 0;  // of all tissue [J/m^2, Pa]; of a cell [m]
};

/// @param folder  for the mesh or image that the scene names
RandomCuts random_cuts(CutKind kind, std::uint64_t seed, const std::string& folder);

}  // namespace palpate::bench
