// The driver "forcedimension": omega, delta, sigma, lambda and Falcon devices through the vendor's libdhd, loaded at run
// time.

#include <map>
#include <mutex>

#include "haptic_node/drivers/forcedimension/dhd_device.h"
#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic {
namespace {

const forcedimension::Dhd& shared_dhd(const std::string& file) {
  static std::mutex gate;
  static std::map<std::string, std::unique_ptr<forcedimension::Dhd>> loaded;
  const std::lock_guard<std::mutex> lock(gate);
  auto& dhd = loaded[file];
  if (!dhd) dhd = std::make_unique<forcedimension::Dhd>(file);
  return *dhd;
}

std::vector<std::string> list() {
  const int n = shared_dhd("").get_available_count();
  std::vector<std::string> ids;
  for (int i = 0; i < n; ++i) ids.push_back(std::to_string(i));
  return ids;
}

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  const std::string library = options.text("library", "");
  options.refuse_rest();
  return std::make_unique<forcedimension::DhdDevice>(host, shared_dhd(library), id);
}

void rescue(const hdev_host&, const std::string& id, kit::Options& options) {
  forcedimension::rescue_device(shared_dhd(options.text("library", "")), id);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"forcedimension", "1.0", list, open, rescue};
  return driver;
}

}  // namespace palpate::haptic
