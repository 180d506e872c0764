#include "haptic_node/drivers/kit/vendor_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>

#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::kit {

VendorLibrary::VendorLibrary(const std::string& what, const std::string& given,
                             const std::vector<std::string>& defaults)
    : what_(what) {
  const std::vector<std::string> names = given.empty() ? defaults : std::vector<std::string>{given};
  std::string said;
  for (const auto& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) {
      file_ = name;
      return;
    }
    said += (said.empty() ? "" : "; ") + std::string(dlerror());
  }
  const char* path = std::getenv("LD_LIBRARY_PATH");
  throw Trouble(
      HDEV_E_SDK,
      fmt::format("the library of {} does not load ({}); looked in LD_LIBRARY_PATH ({}), ld.so.cache, /lib, "
                  "/usr/lib; install it there, or name the file with \"library\"",
                  what, said, path == nullptr || *path == '\0' ? "empty" : path));
}

void* VendorLibrary::look_up(const char* name) const noexcept { return dlsym(handle_, name); }

void* VendorLibrary::address(const char* name) const {
  void* found = look_up(name);
  if (found == nullptr)
    throw Trouble(HDEV_E_SDK, fmt::format("{} lacks {}() ({}); another version of {} is needed", file_, name,
                                          dlerror(), what_));
  return found;
}

}  // namespace palpate::haptic::kit
