#include "haptic_node/control/fault_cause.h"

#include <array>

#include "haptic_node/device/haptic_device.h"

namespace palpate::haptic {
namespace {

struct Words {
  const char* name;
  const char* text;
  const char* advice;
};

/// In the order of FaultCause. Text and advice must fit into a status note together.
constexpr std::array<Words, n_fault_causes> words{{
    {"none", "", ""},
    {"lost", "unplugged, or nobody answers", "check cable and power"},
    {"silent", "the vendor's side stopped calling back", "replug it"},
    {"blocked", "its driver holds up the loop", "try another port"},
    {"impossible", "three impossible samples in a row", "check its sensors"},
    {"overspeed", "moved faster than it allows", "move slower"},
    {"overforce", "more force than it allows", "lower force_limit_N"},
    {"overtemp", "its motors are too warm", "let it cool down"},
    {"force_off", "it switched its forces off by itself", "see its switch and light"},
    {"device_watchdog", "commands reached it too late", "ease the load of this PC"},
    {"emergency_stop", "its emergency button is pressed", "release the button"},
    {"let_go", "its own switch says nobody holds it", "hold it"},
    {"power", "it has no power for its motors", "switch it on"},
    {"internal", "it reports an error of its own", "ask its maker's tool"},
}};

const Words& words_of(FaultCause cause) noexcept {
  const auto i = static_cast<std::size_t>(cause);
  return i < words.size() ? words[i] : words.back();
}

}  // namespace

FaultCause cause_of(std::uint32_t fault_bits) noexcept {
  struct Bit {
    std::uint32_t bit;
    FaultCause cause;
  };
  // What a person did comes first, then what explains the others.
  static constexpr std::array<Bit, 10> order{{{HDEV_FAULT_ESTOP, FaultCause::emergency_stop},
                                              {HDEV_FAULT_DEADMAN, FaultCause::let_go},
                                              {HDEV_FAULT_POWER, FaultCause::power},
                                              {HDEV_FAULT_OVERTEMP, FaultCause::overtemp},
                                              {HDEV_FAULT_SILENT, FaultCause::silent},
                                              {HDEV_FAULT_OVERSPEED, FaultCause::overspeed},
                                              {HDEV_FAULT_OVERFORCE, FaultCause::overforce},
                                              {HDEV_FAULT_WATCHDOG, FaultCause::device_watchdog},
                                              {HDEV_FAULT_FORCE_OFF, FaultCause::force_off},
                                              {HDEV_FAULT_INTERNAL, FaultCause::internal}}};
  for (const auto& [bit, cause] : order)
    if ((fault_bits & bit) != 0) return cause;
  return fault_bits == 0 ? FaultCause::none : FaultCause::internal;
}

const char* name_of(FaultCause cause) noexcept { return words_of(cause).name; }
const char* text_of(FaultCause cause) noexcept { return words_of(cause).text; }
const char* advice_of(FaultCause cause) noexcept { return words_of(cause).advice; }

}  // namespace palpate::haptic
