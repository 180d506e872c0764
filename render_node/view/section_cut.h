#pragma once
// Which side of a section is taken away: that from which one looks.

#include <Eigen/Core>

#include "common/math/vec3.h"
#include "common/scene/section_spec.h"

namespace palpate::render {

/// (n, w): what rests at p is shown where n . p <= w.
inline Eigen::Vector4f section_cut(const SectionSpec& section, const Vec3& eye) {
  const float sign = eye[section.axis] > section.at ? 1.0F : -1.0F;
  Eigen::Vector4f cut = Eigen::Vector4f::Zero();
  cut[section.axis] = sign;
  cut[3] = sign * static_cast<float>(section.at);
  return cut;
}
/// Nothing is taken away.
inline Eigen::Vector4f no_cut() { return {0, 0, 0, 1}; }

inline bool is_cut_away(const Eigen::Vector4f& cut, const Eigen::Vector3f& rest) {
  return cut.head<3>().dot(rest) > cut[3];
}

}  // namespace palpate::render
