// The driver "spacenav": a 3-D mouse through spacenavd and Debian's libspnav. It measures, and has no motors.

#include <cstdlib>
#include <filesystem>

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/spacenav/spacenav_device.h"

namespace palpate::haptic {
namespace {

/// libspnav tells of no device without a connection, and loses memory where there is nobody to connect to; whether a
/// daemon is there can be seen.
void require_daemon() {
  const char* named = std::getenv("SPNAV_SOCKET");
  const std::string socket = named == nullptr ? "/run/spnav.sock" : named;
  std::error_code error;
  if (std::filesystem::is_socket(socket, error)) return;
  throw kit::Trouble(HDEV_E_NODEV,
                     "no spacenavd at " + socket +
                         "; install the package spacenavd and plug in the 3-D mouse, or name its socket "
                         "with \"socket\"");
}

std::vector<std::string> list() {
  require_daemon();
  return {"first"};
}

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  constexpr double radian = 3.14159265358979323846 / 180.0;
  if (!id.empty() && id != "first")
    throw kit::Trouble(HDEV_E_NODEV, "no device \"" + id + "\"; there is only \"first\"");
  spacenav::Settings settings;
  settings.speed = options.positive("speed_mm_per_s", settings.speed * 1e3) * 1e-3;
  settings.turn = options.positive("turn_deg_per_s", settings.turn / radian) * radian;
  settings.half_workspace = options.positive("half_workspace_mm", settings.half_workspace * 1e3) * 1e-3;
  const std::string socket = options.text("socket", "");
  options.refuse_rest();
  if (!socket.empty()) setenv("SPNAV_SOCKET", socket.c_str(), 1);
  require_daemon();
  return std::make_unique<spacenav::SpacenavDevice>(host, settings);
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"spacenav", "1.0", list, open};
  return driver;
}

}  // namespace palpate::haptic
