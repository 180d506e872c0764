#pragma once
// Keys of [device.NAME] that mean the same with every driver. All others belong to the driver that the table names.

#include <array>
#include <string_view>

namespace palpate {

inline constexpr std::array<std::string_view, 9> device_keys = {"driver",    "rate_Hz",   "force_limit_N",
                                                                "rotation",  "scale",     "force_scale",
                                                                "offset_mm", "waypoints", "hand"};

}  // namespace palpate
