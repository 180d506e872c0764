#include "haptic_node/device/driver_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/error/error.h"
#include "common/scene/near_miss.h"

namespace palpate::haptic {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view prefix = "palpate_driver_";
constexpr std::string_view suffix = ".so";
constexpr std::size_t first_table = offsetof(hdev_api, emergency_stop);  // of minor version 0 [bytes]

bool is_driver_name(const std::string& name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), fits);
}

[[noreturn]] void refuse(const std::string& name, const std::string& place, const std::string& why) {
  const auto folders = driver_folders();
  std::vector<std::string> searched;
  for (const auto& folder : folders) searched.push_back(folder.string());
  const auto present = drivers_present(folders);
  const auto meant = near_miss(name, present);
  throw InputError(fmt::format(
      "{}{}driver \"{}\": {}; {}searched {}; drivers there: {}", place, place.empty() ? "" : ": ", name, why,
      meant && *meant != name ? fmt::format("did you mean \"{}\"? ", *meant) : "", fmt::join(searched, ", "),
      present.empty() ? std::string("none") : fmt::format("{}", fmt::join(present, ", "))));
}

/// The first function that the table lacks, or null.
const char* missing_function(const hdev_api& api) {
  const std::array<std::pair<const char*, bool>, 11> functions{{{"enumerate", api.enumerate != nullptr},
                                                                {"open", api.open != nullptr},
                                                                {"get_info", api.get_info != nullptr},
                                                                {"calibrate", api.calibrate != nullptr},
                                                                {"enable_force", api.enable_force != nullptr},
                                                                {"close", api.close != nullptr},
                                                                {"last_error", api.last_error != nullptr},
                                                                {"rt_attach", api.rt_attach != nullptr},
                                                                {"read", api.read != nullptr},
                                                                {"write", api.write != nullptr},
                                                                {"stop", api.stop != nullptr}}};
  for (const auto& [name, present] : functions)
    if (!present) return name;
  return nullptr;
}

/// What is wrong with the table that a driver handed out; empty: nothing.
std::string objection(const hdev_api* api) {
  if (api == nullptr)
    return fmt::format("does not serve ABI {}.{}; rebuild it against haptic_device.h", HDEV_ABI_MAJOR,
                       HDEV_ABI_MINOR);
  if (api->abi_major != HDEV_ABI_MAJOR)
    return fmt::format("speaks ABI {}.{}, this palpate speaks {}.{}; rebuild it against haptic_device.h",
                       api->abi_major, api->abi_minor, HDEV_ABI_MAJOR, HDEV_ABI_MINOR);
  if (api->size < first_table)
    return fmt::format("hands out a table of {} bytes, {} are needed", api->size, first_table);
  if (const char* function = missing_function(*api)) return fmt::format("leaves {}() null", function);
  return {};
}

/// The table as this host knows it: what an older driver does not have is null. One a driver file, for ever.
const hdev_api& known_table(const std::string& file, const hdev_api& given) {
  static std::mutex gate;
  static std::map<std::string, hdev_api> tables;
  const std::lock_guard<std::mutex> lock(gate);
  hdev_api& known = tables[file];
  std::memcpy(&known, &given, std::min<std::size_t>(given.size, sizeof known));
  return known;
}

}  // namespace

std::vector<fs::path> driver_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("PALPATE_DRIVERS")) {
    std::istringstream list(given);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.emplace_back(folder);
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    folders.push_back(program.parent_path() / "drivers");
    folders.push_back(program.parent_path().parent_path() / "lib" / "palpate" / "drivers");
  }
  return folders;
}

std::vector<std::string> drivers_present(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const auto& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string file = entry.path().filename().string();
      if (file.starts_with(prefix) && file.ends_with(suffix) && file.size() > prefix.size() + suffix.size())
        names.push_back(file.substr(prefix.size(), file.size() - prefix.size() - suffix.size()));
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

DriverLibrary DriverLibrary::load(const std::string& name, const std::string& place) {
  if (!is_driver_name(name)) refuse(name, place, "not a driver's name (small letters, digits, underscores)");
  const std::string file_name = std::string(prefix) + name + std::string(suffix);
  fs::path file;
  for (const auto& folder : driver_folders()) {
    std::error_code error;
    if (fs::exists(folder / file_name, error)) {
      file = folder / file_name;
      break;
    }
  }
  if (file.empty()) refuse(name, place, file_name + " not found");

  return load_file(name, file, place);
}

DriverLibrary DriverLibrary::load_file(const std::string& name, const fs::path& file,
                                       const std::string& place) {
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) refuse(name, place, fmt::format("{} does not load ({})", file.string(), dlerror()));
  void* symbol = dlsym(handle, HDEV_ENTRY_SYMBOL);
  if (symbol == nullptr)
    refuse(name, place, fmt::format("{} lacks {}() ({})", file.string(), HDEV_ENTRY_SYMBOL, dlerror()));
  const auto query = reinterpret_cast<hdev_plugin_query_fn>(symbol);
  const hdev_api* api = query(HDEV_ABI_MAJOR, HDEV_ABI_MINOR);
  if (const std::string wrong = objection(api); !wrong.empty())
    refuse(name, place, file.string() + " " + wrong);

  DriverLibrary library;
  library.api_ = &known_table(file.string(), *api);
  library.name_ = name;
  library.path_ = file.string();
  return library;
}

}  // namespace palpate::haptic
