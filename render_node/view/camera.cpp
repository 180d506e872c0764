#include "render_node/view/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/render_spec.h"

namespace palpate::render {
namespace {

constexpr double rad_per_px = 0.006;
constexpr double zoom_per_step = 0.88;
constexpr double margin = 1.08;  // air round what is fitted
constexpr double max_pitch = 0.49 * std::numbers::pi;

}  // namespace

Camera::Camera(const CameraSpec& spec) : spec_(spec), yaw_(0), pitch_(0) { reset(); }

void Camera::reset() {
  yaw_ = spec_.yaw;
  pitch_ = std::clamp(spec_.pitch, -max_pitch, max_pitch);
  target_ = spec_.target.value_or(Vec3::Zero());
  distance_ = spec_.distance.value_or(1.0);
  moved_ = all_ = false;
}

void Camera::look_from(double yaw, double pitch) {
  yaw_ = yaw;
  pitch_ = std::clamp(pitch, -max_pitch, max_pitch);
  moved_ = false;
  all_ = true;
}

void Camera::look_at(const Vec3& p, double height) {
  target_ = p;
  distance_ = std::max(height / (2 * tan_half()), 1e-6);
  moved_ = true;
}

void Camera::set_picture(int width, int height, int covered_left) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  covered_ = std::clamp<double>(covered_left, 0, 0.6 * width_);
}

double Camera::tan_half() const { return std::tan(spec_.field_of_view / 2); }
double Camera::free_aspect() const { return (width_ - covered_) / height_; }

Eigen::Matrix3d Camera::axes() const {
  const double cy = std::cos(yaw_), sy = std::sin(yaw_), cp = std::cos(pitch_), sp = std::sin(pitch_);
  Eigen::Matrix3d rows;
  rows << cy, sy, 0,          //
      -sy * sp, cy * sp, cp,  //
      sy * cp, -cy * cp, sp;
  return rows;
}

Vec3 Camera::eye() const { return target_ + distance_ * axes().row(2).transpose(); }

void Camera::fit(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return;
  radius_ = std::max(box.diagonal().norm() / 2, 1e-6);
  if (moved_) return;
  if (all_ || !spec_.target) target_ = box.center();
  if (spec_.distance && !all_) return;
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = axes() * (box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)) - target_);
    const double across = std::max(std::abs(corner.x()) / free_aspect(), std::abs(corner.y()));
    distance = std::max(distance, margin * across / tan_half() + corner.z());
  }
  distance_ = std::max(distance, 1e-6);
}

void Camera::rotate(double dx_px, double dy_px) {
  yaw_ -= dx_px * rad_per_px;
  pitch_ = std::clamp(pitch_ + dy_px * rad_per_px, -max_pitch, max_pitch);
  moved_ = true;
}

void Camera::pan(double dx_px, double dy_px) {
  const double m_per_px = 2 * distance_ * tan_half() / height_;
  target_ += axes().transpose() * Vec3(-dx_px * m_per_px, dy_px * m_per_px, 0);
  moved_ = true;
}

void Camera::zoom(double steps) {
  distance_ *= std::pow(zoom_per_step, steps);
  moved_ = true;
}

Eigen::Matrix4d Camera::view() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = axes();
  m.topRightCorner<3, 1>() = -axes() * eye();
  return m;
}

Eigen::Matrix4d Camera::projection() const {
  const double near = std::max(0.02 * distance_, distance_ - 4 * radius_);
  const double far = distance_ + 12 * radius_;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = height_ / (width_ * tan_half());
  m(1, 1) = 1 / tan_half();
  m(0, 2) = -covered_ / width_;  // the target in the middle of the free part
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2 * far * near / (far - near);
  m(3, 2) = -1;
  return m;
}

double Camera::depth(const Vec3& p) const { return axes().row(2).dot(eye() - p); }

Vec3 Camera::at(const Eigen::Vector2d& pixel, double depth) const {
  // The ray of a pixel leaves the eye as (a, b, -1) in camera axes; projection() is undone for a and b.
  const double a = (2 * pixel.x() / width_ - 1 - covered_ / width_) * width_ / height_ * tan_half();
  const double b = (1 - 2 * pixel.y() / height_) * tan_half();
  return eye() + depth * (axes().transpose() * Vec3(a, b, -1));
}

std::optional<Eigen::Vector2d> Camera::project(const Vec3& p) const {
  const Eigen::Vector4d clip = projection() * view() * p.homogeneous();
  if (clip.w() <= 0) return std::nullopt;
  return Eigen::Vector2d((clip.x() / clip.w() + 1) * width_ / 2, (1 - clip.y() / clip.w()) * height_ / 2);
}

}  // namespace palpate::render
