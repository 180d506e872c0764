#pragma once
// What stands behind and around: a soft gradient and, where the scene has a floor or walls, a faint grid on each.

#include "render_node/gl/buffer.h"
#include "render_node/gl/program.h"
#include "render_node/view/camera.h"

namespace palpate::render {

class BackdropDrawing {
 public:
  BackdropDrawing();

  /// Fills the picture where nothing has been drawn: after everything opaque, with a depth test that passes what is equal.
  void draw_gradient() const;

  /// A plane, after everything opaque: it fades out from the place nearest to `middle` and lets what is beyond it shine
  /// through. @param normal  unit  @param cell  of the grid [m]  @param reach  where it has faded [m]
  void draw_plane(const Camera& camera, const Vec3& middle, const Vec3& point, const Vec3& normal,
                  double cell, double reach) const;

 private:
  VertexArray array_;  // core OpenGL wants one bound, even an empty one
  Program gradient_;
  Program plane_;
};

}  // namespace palpate::render
