#pragma once
// Why a tool has no force any more, in one value that travels from the tick to whoever tells a person.

#include <cstdint>

namespace palpate::haptic {

enum class FaultCause : std::uint32_t {
  none,
  lost,             // unplugged, or the other side has gone
  silent,           // the vendor's side has stopped calling back
  blocked,          // calls of the driver held up the tick
  impossible,       // three samples in a row that cannot be
  overspeed,        // as the device has it
  overforce,        // likewise
  overtemp,         // motors at their limit
  force_off,        // the device switched its forces off by itself
  device_watchdog,  // commands came too late for the device
  emergency_stop,
  let_go,  // the device's own dead man's switch
  power,
  internal,  // an error that only the device's maker can explain
};
inline constexpr std::uint32_t n_fault_causes = 14;

/// From the HDEV_FAULT_* bits of a sample: the one that says most. 0 is none, a bit that is not known is internal.
FaultCause cause_of(std::uint32_t fault_bits) noexcept;

/// One word for files: "overtemp".
const char* name_of(FaultCause cause) noexcept;
/// What has happened, to follow a colon: "its motors are too warm".
const char* text_of(FaultCause cause) noexcept;
/// What a person can do about it, before the device is opened anew: "let it cool down".
const char* advice_of(FaultCause cause) noexcept;

}  // namespace palpate::haptic
