#pragma once
// A picture in memory and its way to a PNG file.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::render {

struct Image {
  int width = 0, height = 0;      // [px]
  std::vector<std::uint8_t> rgb;  // top row first (height x width x 3)

  const std::uint8_t* at(int x, int y) const {
    return rgb.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
  }
};

/// Writes beside, then renames: `path` is either complete or untouched. It bears the mark that
/// is_own_picture() knows.
/// @throws InputError if the file cannot be written
void write_png(const Image& image, const std::string& path);

}  // namespace palpate::render
