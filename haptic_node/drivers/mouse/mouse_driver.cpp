// The driver "mouse": the mouse in the render window, over DDS. Which domain and tool that is, and where the device lies
// in the world, is told by the host (device/driver_options).

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/mouse/mouse_device.h"

namespace palpate::haptic {
namespace {

constexpr std::uint32_t not_told = 1000;

std::vector<std::string> list() { return {"window"}; }

/// A calibration, R row after row. Told by the host, so that only a host that has gone wrong gets a complaint.
void read_calibration(kit::Options& options, mouse::Settings& settings) {
  settings.scale = options.positive("world_scale", 1.0);
  const auto rotation = options.numbers("world_rotation", 9), offset = options.numbers("world_offset_m", 3);
  for (std::size_t i = 0; i < rotation.size(); ++i)
    settings.rotation(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = rotation[i];
  for (std::size_t i = 0; i < offset.size(); ++i) settings.offset[static_cast<Eigen::Index>(i)] = offset[i];
}

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  if (!id.empty() && id != "window")
    throw kit::Trouble(HDEV_E_NODEV, "no device \"" + id + "\"; there is only \"window\"");
  mouse::Settings settings;
  settings.speed = options.positive("speed_mm_per_s", settings.speed * 1e3) * 1e-3;
  settings.max_force = options.positive("max_force_N", settings.max_force);
  settings.tool = options.whole("tool", 0, max_tools - 1);
  const std::uint32_t domain = options.whole("domain", not_told, not_told);
  read_calibration(options, settings);
  options.refuse_rest();
  if (domain == not_told)
    throw kit::Trouble(
        HDEV_E_NODEV, "there is no window to point in; use palpate run, or another driver in simulated time");
  settings.domain = static_cast<int>(domain);
  return std::make_unique<mouse::MouseDevice>(host, settings);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"mouse", "1.0", list, open};
  return driver;
}

}  // namespace palpate::haptic
