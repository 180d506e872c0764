#pragma once
// What numbers of tissue that come by wire may be.

#include "common/message/messages.h"

namespace palpate::haptic {

/// Both false for what is not a number.
inline bool within(double value, double low, double high) noexcept { return value >= low && value <= high; }
inline bool within(double value, double most) noexcept { return within(value, -most, most); }

}  // namespace palpate::haptic
