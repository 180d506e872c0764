#include "haptic_node/device/calibration.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "common/error/error.h"
#include "common/scene/device_spec.h"

namespace palpate::haptic {

Calibration::Calibration(const DeviceSpec& spec)
    : rotation_(spec.rotation), scale_(spec.scale), force_scale_(spec.force_scale), offset_(spec.offset) {
  std::vector<std::string> complaints;
  const auto complain = [&](const std::string& what) {
    const std::string place = spec.place.file.empty() ? std::string() : spec.place.text() + ": ";
    complaints.push_back(fmt::format("{}[device.{}]: {}", place, spec.name, what));
  };
  constexpr double tolerance = 1e-3;  // three digits written by hand
  const double skew = (rotation_.transpose() * rotation_ - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!rotation_.allFinite() || !(skew <= tolerance))
    complain("rotation is not a rotation; its rows must be unit and at right angles");
  else if (rotation_.determinant() < 0)
    complain("rotation mirrors (determinant -1); turn one axis round");
  if (!std::isfinite(scale_) || scale_ <= 0) complain(fmt::format("scale is {}; it must be above 0", scale_));
  if (!std::isfinite(force_scale_) || force_scale_ <= 0)
    complain(fmt::format("force_scale is {}; it must be above 0", force_scale_));
  if (!offset_.allFinite()) complain("offset is not finite");
  if (!complaints.empty()) throw InputError(complaints);
  rotation_ = Eigen::Quaterniond(rotation_).normalized().toRotationMatrix();
}

}  // namespace palpate::haptic
