#pragma once
// What numbers of tissue that come by wire may be.

#include "common/message/messages.h"

namespace palpate::haptic {

// Why: a tenth of a gram on what stands for "does not give", 1e9 N/m; what is beyond is no tissue.
inline constexpr double largest_stiffness = 1e13;  // omega^2 [1/s^2]
inline constexpr double largest_damping = 1e7;     // [1/s]
inline constexpr double largest_phi = 1e3;         // of a microgram [1 / sqrt(kg)]
inline constexpr double largest_state = 1e6;       // of q [m sqrt(kg)] and of w

/// Both false for what is not a number.
inline bool within(double value, double low, double high) noexcept { return value >= low && value <= high; }
inline bool within(double value, double most) noexcept { return within(value, -most, most); }

}  // namespace palpate::haptic
