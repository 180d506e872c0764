// The driver "openigtlink": poses from a tracker server (PlusServer, 3D Slicer, a vendor's own), through Debian's library.

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/openigtlink/igtl_device.h"

namespace palpate::haptic {
namespace {

/// Tools have names that only their server knows.
std::vector<std::string> list() { return {}; }

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  openigtlink::Settings settings;
  settings.host = options.text("server_host", settings.host);
  settings.port = std::to_string(options.whole("server_port", 18944, 65535));
  settings.half_workspace = options.positive("half_workspace_mm", settings.half_workspace * 1e3) * 1e-3;
  options.refuse_rest();
  return std::make_unique<openigtlink::IgtlDevice>(host, settings, id);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"openigtlink", "1.0", list, open};
  return driver;
}

}  // namespace palpate::haptic
