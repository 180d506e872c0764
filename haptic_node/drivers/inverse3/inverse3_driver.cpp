// The driver "inverse3": a Haply Inverse3 through the vendor's service, which runs on this machine or another one.

#include "haptic_node/drivers/inverse3/inverse3_device.h"
#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic {
namespace {

std::vector<std::string> list() { return inverse3::list_devices({}); }

inverse3::Settings read_settings(kit::Options& options) {
  inverse3::Settings settings;
  settings.host = options.text("service_host", settings.host);
  settings.port = std::to_string(options.whole("service_port", 10001, 65535));
  settings.dialect.force_key = options.text("force_key", settings.dialect.force_key);
  settings.dialect.profile = options.text("profile", settings.dialect.profile);
  settings.rate_Hz = options.positive("service_Hz", settings.rate_Hz);
  settings.max_force = options.positive("max_force_N", settings.max_force);
  settings.max_stiffness = options.positive("max_stiffness_N_per_m", settings.max_stiffness);
  options.refuse_rest();
  return settings;
}

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  return std::make_unique<inverse3::Inverse3Device>(host, read_settings(options), id);
}

void rescue(const hdev_host&, const std::string& id, kit::Options& options) {
  inverse3::rescue_device(read_settings(options), id);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"inverse3", "1.0", list, open, rescue};
  return driver;
}

}  // namespace palpate::haptic
