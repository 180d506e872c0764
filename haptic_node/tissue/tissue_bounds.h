#pragma once
// What numbers of tissue that come by wire may be.

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate::haptic {

inline constexpr double largest_friction = 10;

/// All false for what is not a number.
inline bool within(double value, double low, double high) noexcept { return value >= low && value <= high; }
inline bool within(double value, double most) noexcept { return within(value, -most, most); }
inline bool within(const Vec3& value, double most) noexcept {
  return within(value.x(), most) && within(value.y(), most) && within(value.z(), most);
}

}  // namespace palpate::haptic
