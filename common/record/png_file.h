#pragma once
// Pictures in shades of grey, from and to PNG files. The one place that reads a PNG.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate {

struct GreyPicture {
  int width = 0, height = 0;         // [px]
  int bits = 8;                      // 8: values 0..255; 16: 0..65535
  std::vector<std::uint16_t> value;  // top row first (height x width)

  std::uint16_t at(int x, int y) const {
    return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Most pixels along a side of a picture that is read.
inline constexpr int most_pixels = 8192;

/// Reads any PNG, plain or interlaced: grey of 1 to 16 bits (fewer than 8 are stretched to 0..255), colours and palettes as
/// their luminance (0.2126 R + 0.7152 G + 0.0722 B of the stored values, Rec. ITU-R BT.709; equal values stay what they are).
/// Transparency is left out, and so is a gamma that the file may name.
/// @throws InputError: missing, not a PNG, truncated or damaged, too large
GreyPicture read_grey_png(const std::string& path);

/// Writes 8 or 16 bits beside, then renames: `path` is either complete or untouched.
/// @throws InputError if the file cannot be written
void write_grey_png(const GreyPicture& picture, const std::string& path);

}  // namespace palpate
