#pragma once
// How a tip presses a place of an image, and which cells there move so that two cores keep up.

#include <array>
#include <vector>

#include "common/scene/device_spec.h"
#include "common/scene/material_spec.h"
#include "deploy/palpate/image_tissue.h"
#include "deploy/palpate/touch_place.h"

namespace palpate::deploy {

struct PressPlan {
  MaterialSpec material;              // soft tissue
  double depth = 0;                   // of the hand below the surface at rest [m]
  std::vector<Waypoint> path;         // from outside to the surface, in, held, and back
  std::array<int, 3> center_voxel{};  // as the image counts
  int radius_voxels = 0;              // of the region that moves
  int n_moving = 0;                   // cells in it
  double real_time_factor = 0;        // forecast, on one thread, pressed
};

/// @throws InputError  no region both moves and is held by tissue around it
PressPlan plan_press(const ImageTissue& tissue, const TouchPlace& place, const std::string& path);

}  // namespace palpate::deploy
