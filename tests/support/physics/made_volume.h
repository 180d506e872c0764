#pragma once
// Small volumes made on the spot, and bodies from them.

#include <functional>
#include <string>

#include "common/record/volume.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"

namespace palpate::physics::test {

/// A volume of 2 mm cells whose intensity is value(i, j, k).
inline Volume made_volume(std::array<int, 3> size, const std::function<float(int, int, int)>& value) {
  Volume volume;
  volume.size = volume.source_size = size;
  volume.spacing = {0.002, 0.002, 0.002};
  volume.source = "made";
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) volume.intensity.push_back(value(i, j, k));
  volume.transfer = grey_transfer(0, 400);
  return volume;
}

/// A block of tissue, of which air are two cells at each side and one below and above.
inline Volume block_volume(const std::array<int, 3>& n) {
  return made_volume(n, [&](int i, int j, int k) {
    const bool in = i >= 2 && i < n[0] - 2 && j >= 2 && j < n[1] - 2 && k >= 1 && k < n[2] - 1;
    return in ? 100.0F : -100.0F;
  });
}

/// A body of that volume's voxels within [lo, hi].
inline BodySpec volume_body(const std::string& file, double lo, double hi) {
  BodySpec spec;
  spec.name = "image";
  spec.lattice = LatticeKind::voxel;
  spec.material = "m";
  VolumeShape shape;
  shape.file = file;
  shape.keep_min = lo;
  shape.keep_max = hi;
  spec.shape = shape;
  return spec;
}

inline MaterialSpec soft_material() {
  MaterialSpec material;
  material.name = "m";
  material.density = 1000;
  material.modulus = 20e3;
  return material;
}

}  // namespace palpate::physics::test
