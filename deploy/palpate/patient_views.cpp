#include "deploy/palpate/patient_views.h"

#include <algorithm>
#include <cmath>

#include "common/math/vec3.h"

namespace palpate::deploy {
namespace {

constexpr double steep = 0.9;  // sine of a pitch from which a direction says little of the yaw

/// @param d  unit, in the world  @param yaw  of a look that goes up or down
PatientView along(const Vec3& d, double yaw) {
  PatientView view;
  view.pitch = std::asin(std::clamp(-d.z(), -1.0, 1.0));
  view.yaw = std::abs(d.z()) > steep ? yaw : std::atan2(-d.x(), d.y());
  d.cwiseAbs().maxCoeff(&view.axis);
  return view;
}

}  // namespace

PatientViews patient_views(const Volume& volume) {
  Eigen::Matrix3d to_patient = volume.orientation.value_or(Eigen::Matrix3d::Identity());
  if (volume.is_left_handed()) to_patient.col(0) *= -1;  // as the body stands in the world
  const auto in_world = [&](const Vec3& lps) { return Vec3((to_patient.transpose() * lps).normalized()); };
  PatientViews views;
  views.front = along(in_world(Vec3::UnitY()), 0);
  views.side = along(in_world(-Vec3::UnitX()), views.front.yaw);
  views.top = along(in_world(-Vec3::UnitZ()), views.front.yaw);
  return views;
}

}  // namespace palpate::deploy
