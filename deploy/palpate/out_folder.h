#pragma once
// The folder that a session leaves its results in.

#include <filesystem>
#include <string>
#include <utility>

namespace palpate::deploy {

/// out/<name of the scene file>
std::filesystem::path default_out(const std::string& scene_path);

/// While it lives no other palpate takes the folder; a process that ends in any way releases it.
class HeldFolder {
 public:
  /// @throws InputError if another holds it
  explicit HeldFolder(const std::filesystem::path& folder);
  ~HeldFolder();
  HeldFolder(HeldFolder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  HeldFolder& operator=(HeldFolder&&) = delete;

 private:
  int descriptor_;
};

/// Makes the folder, makes sure that it may be written to, and removes what an earlier session left there (summary,
/// plots, its own pictures in frames/, parts/; nothing else is touched).
/// @return hold it for as long as something is written there
/// @throws InputError naming the folder
[[nodiscard]] HeldFolder prepare_out(const std::filesystem::path& out);

}  // namespace palpate::deploy
