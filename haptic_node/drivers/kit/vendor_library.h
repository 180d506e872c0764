#pragma once
// A vendor's library, found and loaded at run time: palpate is built without it and carries none of it.

#include <string>
#include <vector>

namespace palpate::haptic::kit {

/// Stays loaded until the program ends: vendors' libraries leave threads and exit handlers behind.
class VendorLibrary {
 public:
  /// Tries file names in their order, each as the loader searches for it ($LD_LIBRARY_PATH, ld.so.cache, system
  /// folders); a name with a slash is that file.
  /// @param what      for a person: "OpenHaptics"
  /// @param given     the only file name; empty: `defaults`
  /// @throws Trouble (HDEV_E_SDK), one line: the files, the loader's own words for each, where it looked
  VendorLibrary(const std::string& what, const std::string& given, const std::vector<std::string>& defaults);

  /// `function` becomes the exported C function. @throws Trouble (HDEV_E_SDK) naming the file and the function
  template <class Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address(name));
  }
  /// The same for one that older versions lack: null then.
  template <class Function>
  void find_if_there(const char* name, Function*& function) const noexcept {
    function = reinterpret_cast<Function*>(look_up(name));
  }

  const std::string& file() const noexcept { return file_; }

 private:
  void* address(const char* name) const;
  void* look_up(const char* name) const noexcept;
  std::string what_;
  std::string file_;
  void* handle_ = nullptr;
};

}  // namespace palpate::haptic::kit
