#pragma once
// --set table.key=value over a parsed scene file.

#include <string>
#include <vector>

#include "common/scene/toml.h"

#include "common/scene/complaints.h"

namespace palpate {

/// Writes each setting into `root`. What it writes is placed at "--set table.key=value", so that later complaints
/// name the setting and not a line of the file. With another `device.NAME.driver` the keys that the file gives for its own
/// driver are left out.
void apply_settings(toml::table& root, const std::vector<std::string>& settings, Complaints& complaints);

}  // namespace palpate
