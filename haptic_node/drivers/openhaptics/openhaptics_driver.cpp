// The driver "openhaptics": Touch, Touch X and Phantom devices through the vendor's libHD, loaded at run time.

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/openhaptics/hd_device.h"
#include "haptic_node/drivers/openhaptics/hd_emergency.h"

namespace palpate::haptic {
namespace {

/// What the vendor's tools call the first device. A null name, which should mean it, fails on some installations.
const char* const first_device = "Default PHANToM";

/// libHD cannot say which devices there are.
std::vector<std::string> list() {
  openhaptics::shared_hd("");
  return {first_device};
}

void rescue(const hdev_host&, const std::string& id, kit::Options& options) {
  openhaptics::rescue_device(openhaptics::shared_hd(options.text("library", "")),
                             id.empty() ? first_device : id);
}

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  const std::string library = options.text("library", "");
  const std::uint32_t rate_Hz = options.whole("scheduler_Hz", 1000, 5000);
  options.refuse_rest();
  if (rate_Hz == 0) throw kit::Trouble(HDEV_E_ARG, "scheduler_Hz is \"0\"; 500 or 1000 are usual");
  const auto& hd = openhaptics::shared_hd(library);
  return std::make_unique<openhaptics::HdDevice>(host, hd, id.empty() ? first_device : id, rate_Hz);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"openhaptics", "1.0", list, open, rescue};
  return driver;
}

}  // namespace palpate::haptic
