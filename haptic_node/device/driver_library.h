#pragma once
// Finds and loads the driver that a scene names. A driver is palpate_driver_NAME.so (haptic_device.h is the contract).

#include <filesystem>
#include <string>
#include <vector>

#include "haptic_node/device/haptic_device.h"

namespace palpate::haptic {

/// Where drivers are looked for, in this order: the folders of $PALPATE_DRIVERS (separated by ':'), `drivers` beside
/// the running program, and `../lib/palpate/drivers` from there.
std::vector<std::filesystem::path> driver_folders();

/// Names of all drivers in these folders, sorted.
std::vector<std::string> drivers_present(const std::vector<std::filesystem::path>& folders);

/// A loaded driver. It stays loaded until the program ends: vendor libraries leave threads and exit handlers behind.
class DriverLibrary {
 public:
  /// @param name   as in the scene: small letters, digits, underscores
  /// @param place  "file:line:column" of that name, or empty
  /// @throws InputError, one line: the name, the loader's own words, where it was looked for, which drivers there are
  static DriverLibrary load(const std::string& name, const std::string& place = {});

  /// The same for a file that is known already.
  static DriverLibrary load_file(const std::string& name, const std::filesystem::path& file,
                                 const std::string& place = {});

  const hdev_api& api() const noexcept { return *api_; }
  const std::string& name() const noexcept { return name_; }
  const std::string& path() const noexcept { return path_; }

 private:
  DriverLibrary() = default;
  const hdev_api* api_ = nullptr;
  std::string name_;
  std::string path_;
};

}  // namespace palpate::haptic
