#pragma once
// From where a body that was made of an image shows the patient's front, side and top.

#include "common/record/volume.h"

namespace palpate::deploy {

struct PatientView {
  double yaw = 0, pitch = 0;  // of a camera (render_node/view/camera.h) [rad]
  int axis = 0;               // of the world, along which it looks most: a cut across it is seen from there
};

struct PatientViews {
  PatientView front, side, top;  // at the face, at the left side, from above
};

/// By the directions that the image has; without any, as if it were in LPS: x to the left, y to the back, z to the head.
PatientViews patient_views(const Volume& volume);

}  // namespace palpate::deploy
