#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/error/error.h"
#include "common/time/clock.h"
#include "deploy/palpate/doctor.h"
#include "haptic_node/device/driver_library.h"

namespace palpate::deploy {
namespace {

/// What palpate comes with, and the package that a driver needs to be built.
constexpr std::array<std::pair<const char*, const char*>, 8> shipped{{{"simulated", ""},
                                                                      {"replay", ""},
                                                                      {"mouse", ""},
                                                                      {"openhaptics", ""},
                                                                      {"forcedimension", ""},
                                                                      {"inverse3", ""},
                                                                      {"spacenav", "libspnav-dev"},
                                                                      {"openigtlink", "libopenigtlink-dev"}}};

/// Asks the driver itself what it finds.
Finding ask(const std::string& name) {
  try {
    const haptic::DriverLibrary library = haptic::DriverLibrary::load(name);
    hdev_host host{};
    host.size = sizeof host;
    host.log = [](void*, int, const char*) {};
    host.now_ns = [](void*) { return now_ns(); };
    std::array<char[64], 8> ids{};
    std::uint32_t n = 0;
    if (library.api().enumerate(&host, ids.data(), static_cast<std::uint32_t>(ids.size()), &n) != HDEV_OK)
      return {"driver", Finding::State::lacks,
              fmt::format("{}: {}", name, library.api().last_error(nullptr))};
    std::vector<std::string> known;
    for (std::uint32_t i = 0; i < std::min<std::size_t>(n, ids.size()); ++i)
      known.push_back(fmt::format("\"{}\"", ids[i]));
    return {"driver", Finding::State::ok,
            known.empty() ? fmt::format("{}: ready; it names no device by itself", name)
                          : fmt::format("{}: ready; id = {}", name, fmt::join(known, " or "))};
  } catch (const InputError& error) {
    return {"driver", Finding::State::lacks, error.what()};
  }
}

}  // namespace

std::vector<Finding> check_drivers() {
  const auto present = haptic::drivers_present(haptic::driver_folders());
  std::vector<Finding> findings;
  for (const auto& name : present) findings.push_back(ask(name));
  for (const auto& [name, package] : shipped) {
    if (std::find(present.begin(), present.end(), name) != present.end()) continue;
    // Without the simulated hand no scene that comes along runs.
    const bool needed = std::string_view(name) == "simulated";
    findings.push_back(
        {"driver", needed ? Finding::State::fails : Finding::State::lacks,
         *package == '\0'
             ? fmt::format("{}: not there; build or install palpate again", name)
             : fmt::format("{}: left out of this build; install {} and build again", name, package)});
  }
  return findings;
}

}  // namespace palpate::deploy
