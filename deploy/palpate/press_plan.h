#pragma once
// How a tip presses a place of an image, and how much about it is awake so that two cores keep up.

#include <Eigen/Geometry>
#include <vector>

#include "common/scene/device_spec.h"
#include "common/scene/material_spec.h"
#include "deploy/palpate/image_tissue.h"
#include "deploy/palpate/touch_place.h"

namespace palpate::deploy {

struct PressPlan {
  MaterialSpec material;        // soft tissue
  double depth = 0;             // of the hand below the surface at rest [m]
  std::vector<Waypoint> path;   // from outside to the surface, in, held, and back
  Eigen::AlignedBox3d held;     // of the tissue what lies opposite, in the world [m]
  double awake = 0;             // radius about the tip [m]
  int n_awake = 0;              // cells in it
  double real_time_factor = 0;  // forecast, on one thread, pressed
};

/// @throws InputError  no part is awake and held by tissue around it
PressPlan plan_press(const ImageTissue& tissue, const TouchPlace& place, const std::string& path);

}  // namespace palpate::deploy
