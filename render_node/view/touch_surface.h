#pragma once
// The surface over which the mouse leads a tool: all bodies as they were when it took the tool. What the tool presses
// in does not count, or each picture would see the dent and lead the tool deeper into it.

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "render_node/model/body_picture.h"
#include "render_node/view/camera.h"
#include "render_node/view/section_cut.h"

namespace palpate::render {

class TouchSurface {
 public:
  /// Copies what is shown now. @param hidden  bodies not to be met, as in the scene; may be shorter than bodies
  /// @param cut  what of them is taken away (section_cut.h)
  void keep(std::span<const BodyPicture> bodies, const std::vector<bool>& hidden,
            const std::optional<Eigen::Vector4f>& cut = {});
  /// Sections, behind which nothing is met, nor they themselves: a tool would lie in tissue.
  void keep_sections(std::span<const BodyPicture> sections);

  /// A point just before the nearest surface under a pixel: `before` and half an edge of the body hit, in depth, so
  /// that a smooth plane through a surface of steps still lies behind it. Nothing: the pixel shows none.
  /// Cost: one pass over all facets; none while pixel and camera stay.
  /// @param before  e.g. the radius of a stick [m]
  std::optional<Vec3> under(const Camera& camera, const Eigen::Vector2d& pixel, double before);

 private:
  struct Kept {
    Surface surface;
    double edge = 0;      // mean length [m]
    bool blocks = false;  // a section
  };
  std::vector<Kept> kept_;
  struct Asked {
    Eigen::Vector2d pixel;
    Eigen::Matrix4d view;
    double before = 0;
  };
  std::optional<Asked> asked_;
  std::optional<Vec3> answer_;
};

}  // namespace palpate::render
