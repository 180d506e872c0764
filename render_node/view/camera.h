#pragma once
// An orbit camera: it looks at a target, world z is up. Yaw 0 stands on the -y side and looks along +y (a patient's
// face in LPS); positive yaw walks counter-clockwise seen from above; pitch is the height above the horizon.
// Dragging turns the object under the hand.

#include <Eigen/Geometry>
#include <optional>

#include "common/math/vec3.h"
#include "common/scene/render_spec.h"

namespace palpate::render {

class Camera {
 public:
  explicit Camera(const CameraSpec& spec);

  /// The picture: size in pixels, and how many of them on the left are covered by panels. The target appears in the
  /// middle of what is free.
  void set_picture(int width, int height, int covered_left);

  /// Chooses what the scene left open (target, distance) so that the box fills the free part of the picture.
  /// Does nothing once a hand has moved the camera.
  void fit(const Eigen::AlignedBox3d& box);

  void rotate(double dx_px, double dy_px);
  void pan(double dx_px, double dy_px);
  void zoom(double steps);  // > 0: nearer
  void reset();             // back to the scene's view; the next fit() counts again

  /// From another side, with all in the picture whatever the scene says: fit() chooses target and distance.
  void look_from(double yaw, double pitch);
  void fit_all() { look_from(yaw_, pitch_); }
  /// At a point from where it looks now, so near that this height of it fills the picture. @param height  > 0 [m]
  void look_at(const Vec3& p, double height);

  /// Of lengths across the view at the depth of the target.
  double pixels_per_metre() const { return height_ / (2 * distance_ * tan_half()); }

  Eigen::Matrix4d view() const;        // world to camera (x right, y up, z towards the viewer)
  Eigen::Matrix4d projection() const;  // camera to clip space
  /// Where a point appears, in pixels from the top left corner; nothing if behind the camera.
  std::optional<Eigen::Vector2d> project(const Vec3& p) const;

  /// How far a point is before the eye, along the view [m].
  double depth(const Vec3& p) const;
  /// The point that appears at this pixel so far before the eye: the other way round than project(). @param depth  > 0 [m]
  Vec3 at(const Eigen::Vector2d& pixel, double depth) const;

  Vec3 eye() const;
  Vec3 target() const { return target_; }
  double distance() const { return distance_; }

  Eigen::Matrix3d axes() const;  // rows: right, up, towards the viewer; world to camera

 private:
  double tan_half() const;     // of the vertical field of view
  double free_aspect() const;  // width / height of the free part

  CameraSpec spec_;
  double yaw_, pitch_;
  Vec3 target_ = Vec3::Zero();
  double distance_ = 1;
  bool moved_ = false, all_ = false;  // a hand has moved it; it shows all, whatever the scene says
  double radius_ = 0.5;               // of what is looked at, for the depth range [m]
  double width_ = 1280, height_ = 720, covered_ = 0;
};

}  // namespace palpate::render
