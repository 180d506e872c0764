#pragma once
// Which pictures in a folder are palpate's own: by their name, frame_00001.png and so on, and by the mark
// that write_png() leaves in every picture. Both must hold before one is removed or counted; what a person
// put there is neither.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpate::render {

/// "frame_00012.png"
std::string frame_name(int number);
/// 12 of "frame_00012.png"; nothing of any other name.
std::optional<int> frame_number(const std::string& name);

/// A file, no link, that begins as write_png() begins one. Whatever cannot be read is not ours.
bool is_own_picture(const std::filesystem::path& path) noexcept;

struct OwnPicture {
  int number = 0;
  std::uint64_t bytes = 0;
};

/// The frames in a folder that are ours, by number; none where there is no such folder.
std::vector<OwnPicture> own_pictures(const std::filesystem::path& folder);

}  // namespace palpate::render
