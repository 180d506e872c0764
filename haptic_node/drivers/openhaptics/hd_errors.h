#pragma once
// What the errors of libHD mean for the host.

#include <cstdint>
#include <string>

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {

/// What one error says in the middle of a session: a transfer that failed, or HDEV_FAULT_* bits.
struct Meaning {
  bool transfer_failed = false;
  std::uint32_t fault = 0;
};
Meaning meaning_of(unsigned int code) noexcept;

/// "device communication error (0x0302, internal 7)"
std::string words_of(const Hd& hd, const HDErrorInfo& error);

/// Why a device could not be opened, with what a person can do about it.
kit::Trouble open_trouble(const Hd& hd, const std::string& name, const HDErrorInfo& error);

/// Empties libHD's list of errors.
void forget_errors(const Hd& hd) noexcept;

}  // namespace palpate::haptic::openhaptics
