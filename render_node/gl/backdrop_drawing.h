#pragma once
// What stands behind and below: a soft gradient and, where the scene has a floor, a faint grid on it.

#include "render_node/gl/buffer.h"
#include "render_node/gl/program.h"
#include "render_node/view/camera.h"

namespace palpate::render {

class BackdropDrawing {
 public:
  BackdropDrawing();

  /// Fills the picture; leaves the depth alone.
  void draw_gradient() const;

  /// The floor after everything opaque: it fades out from `middle` and lets what is below it shine through.
  /// @param height  of the floor [m]  @param cell  of the grid [m]  @param reach  where it has faded [m]
  void draw_floor(const Camera& camera, const Eigen::Vector3d& middle, double height, double cell,
                  double reach) const;

 private:
  VertexArray array_;  // core OpenGL wants one bound, even an empty one
  Program gradient_;
  Program floor_;
};

}  // namespace palpate::render
