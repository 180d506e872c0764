#pragma once
// Between the arrays of messages and the vectors of algebra.

#include <Eigen/Core>

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate {

inline Vec3 vec(const Array3& a) noexcept { return {a[0], a[1], a[2]}; }
inline Array3 array(const Vec3& v) noexcept { return {v.x(), v.y(), v.z()}; }

}  // namespace palpate
