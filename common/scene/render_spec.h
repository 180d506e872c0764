#pragma once
// [render] and [camera] of a scene: what is shown, from where.

#include <array>
#include <optional>

#include "common/math/vec3.h"
#include "common/scene/colour_kind.h"
#include "common/scene/section_spec.h"

namespace palpate {

struct CameraSpec {
  double yaw = 0.6, pitch = 0.25;  // [rad] about the world z axis, above the horizon
  std::optional<double> distance;  // [m]; absent: all bodies fit
  std::optional<Vec3> target;      // [m]; absent: middle of all bodies
  double field_of_view = 0.6;      // [rad], vertical
};
struct RenderSpec {
  std::array<int, 2> size_px{1280, 720};
  CameraSpec camera;
  std::optional<double> threshold;     // intensity shown from; absent: each volume's keep_min
  std::optional<SectionSpec> section;  // cut open; absent: whole
  std::optional<double> inside;        // intensity from which what lies inside is shown; absent: it is not
  double opacity = 1;                  // of tissue, (0, 1]
  bool show_tool = true, show_force = true, show_panels = true, show_wire = false;
  bool show_fragments = false;  // every fragment but the largest in a colour of its own
  ColourKind colour = ColourKind::own;
  double rate_Hz = 10;  // frames per simulated second when headless
  // What the frames of one run may take on the disk. Where that is reached, every second one goes and half
  // as many come.
  int most_frames = 400;
  double most_frame_bytes = 200e6;
};

}  // namespace palpate
