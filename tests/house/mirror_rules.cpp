// Unit tests mirror the rooms: a folder of a node or of common has a folder of the same name below tests/unit, or a reason.
#include <algorithm>
#include <map>
#include <set>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

/// Rooms without unit tests of their own name, and where their tests are.
const std::map<std::string, std::string>& excused() {
  static const std::map<std::string, std::string> rooms = {
      {"common/error",
       "a class and a macro; tests/unit/common/scene and tests/system/command_test.cpp see what they print"},
      {"common/message", "plain structs; tests/unit/common/wire/convert_test.cpp sends each"},
      {"haptic_node/drivers/forcedimension", "tests/unit/haptic_node/drivers/forcedimension_driver_test.cpp"},
      {"haptic_node/drivers/inverse3", "tests/unit/haptic_node/drivers/inverse3_driver_test.cpp"},
      {"haptic_node/drivers/kit",
       "tests/unit/haptic_node/drivers/plugin_abi_test.cpp opens each driver made with it"},
      {"haptic_node/drivers/mouse", "tests/unit/haptic_node/drivers/mouse_driver_test.cpp"},
      {"haptic_node/drivers/openhaptics", "tests/unit/haptic_node/drivers/openhaptics_driver_test.cpp"},
      {"haptic_node/drivers/openigtlink", "tests/unit/haptic_node/drivers/openigtlink_driver_test.cpp"},
      {"haptic_node/drivers/replay", "tests/unit/haptic_node/drivers/replay_driver_test.cpp"},
      {"haptic_node/drivers/simulated", "tests/unit/haptic_node/drivers/simulated_driver_test.cpp"},
      {"haptic_node/drivers/spacenav", "tests/unit/haptic_node/drivers/spacenav_driver_test.cpp"},
      {"haptic_node/guardian", "a process that outlives its node: tests/system/motors_off_test.cpp"},
  };
  return rooms;
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }
bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

}  // namespace

std::vector<std::string> mirror_breaches(const std::vector<SourceFile>& files) {
  std::set<std::string> rooms, tested;
  for (const SourceFile& file : files) {
    const std::string folder = folder_of(file.path);
    for (const auto* top : {"common/", "physics_node/", "haptic_node/", "render_node/"})
      if (file.path.starts_with(top) && folder.find('/') != folder.npos &&
          (ends_with(file.path, ".h") || ends_with(file.path, ".cpp")))
        rooms.insert(folder);
    if (file.path.starts_with("tests/unit/") && ends_with(file.path, "_test.cpp"))
      tested.insert(folder.substr(11));
  }
  std::vector<std::string> breaches;
  if (tested.empty()) return breaches;
  for (const std::string& room : rooms)
    if (tested.count(room) == 0 && excused().count(room) == 0)
      breaches.push_back(room + ":1: a room without unit tests; write tests/unit/" + room +
                         "/*_test.cpp, or its reason into tests/house/mirror_rules.cpp");
  const bool whole_house = std::any_of(files.begin(), files.end(), [](const SourceFile& file) {
    return file.path == "tests/house/mirror_rules.cpp";
  });
  for (const auto& [room, reason] : excused())
    if (whole_house && (rooms.count(room) == 0 || tested.count(room) > 0))
      breaches.push_back("tests/house/mirror_rules.cpp:1: excuses " + room + ", which " +
                         (tested.count(room) > 0 ? "has tests" : "is no room") + "; take it out of the list");
  return breaches;
}

}  // namespace palpate::house
