#pragma once
// A bar of round length that says how large what is seen is. In perspective that holds at one depth: that of the point
// which the camera looks at.

#include <string>

#include "render_node/view/camera.h"

namespace palpate::render {

struct ScaleBar {
  double metres = 0;  // 1, 2 or 5 times a power of ten
  double px = 0;      // that long in the picture
  std::string words;  // "20 mm"
};

/// The longest bar of at most `most_px`. @param most_px  > 0
ScaleBar scale_bar(const Camera& camera, double most_px);

}  // namespace palpate::render
