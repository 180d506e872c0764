#include "tests/support/image/made_png.h"

#include <png.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace palpate::test {
namespace {

struct Layout {
  int colour_type, channels;
};

Layout layout_of(PngKind kind) {
  switch (kind) {
    case PngKind::grey:
      return {PNG_COLOR_TYPE_GRAY, 1};
    case PngKind::rgb:
      return {PNG_COLOR_TYPE_RGB, 3};
    case PngKind::palette:
      return {PNG_COLOR_TYPE_PALETTE, 1};
    case PngKind::grey_alpha:
      return {PNG_COLOR_TYPE_GRAY_ALPHA, 2};
    case PngKind::rgb_alpha:
      return {PNG_COLOR_TYPE_RGB_ALPHA, 4};
  }
  return {};
}

}  // namespace

void make_png(const std::string& path, const PngRecipe& recipe,
              const std::function<unsigned(int, int, int)>& value) {
  const auto [colour_type, channels] = layout_of(recipe.kind);
  // Rows of whole bytes: libpng packs them where a number has fewer bits.
  const std::size_t bytes_of_number = recipe.bits == 16 ? 2 : 1;
  std::vector<std::vector<png_byte>> rows;
  for (int y = 0; y < recipe.height; ++y) {
    auto& row = rows.emplace_back();
    for (int x = 0; x < recipe.width; ++x)
      for (int c = 0; c < channels; ++c) {
        const unsigned v = value(x, y, c);
        if (bytes_of_number == 2) row.push_back(static_cast<png_byte>(v >> 8));
        row.push_back(static_cast<png_byte>(v & 0xffU));
      }
  }
  std::vector<png_bytep> row_starts;
  for (auto& row : rows) row_starts.push_back(row.data());

  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(recipe.width), static_cast<png_uint_32>(recipe.height),
               recipe.bits, colour_type, recipe.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::array<png_color, 256> palette{};
  for (std::size_t n = 0; n < palette.size(); ++n)
    palette[n] = {static_cast<png_byte>(n), static_cast<png_byte>(2 * n & 0xff),
                  static_cast<png_byte>(3 * n & 0xff)};
  if (recipe.kind == PngKind::palette) png_set_PLTE(png, info, palette.data(), 1 << recipe.bits);
  png_write_info(png, info);
  if (recipe.bits < 8) png_set_packing(png);
  png_write_image(png, row_starts.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

}  // namespace palpate::test
