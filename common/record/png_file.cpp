#include "common/record/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "common/error/error.h"
#include "common/file/new_file.h"

namespace palpate {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

void stay_silent(png_structp, png_const_charp) {}  // a remark about a picture that can be read
[[noreturn]] void jump_back(png_structp png, png_const_charp) { png_longjmp(png, 1); }

/// A PNG being read. libpng reports through longjmp, so the functions that call it keep nothing with a destructor.
struct Decoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  int channels = 0;

  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }

  /// Sets the size and depth of the picture, and libpng to one or three channels of 8 or 16 bits in the order of this machine.
  bool begin(std::FILE* file, GreyPicture& picture) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, stay_silent);
    if (png == nullptr) return false;
    info = png_create_info_struct(png);
    if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_user_limits(png, most_pixels, most_pixels);
    png_init_io(png, file);
    png_read_info(png, info);
    const bool deep = png_get_bit_depth(png, info) == 16;
    png_set_palette_to_rgb(png);
    if ((png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR) == 0) png_set_expand_gray_1_2_4_to_8(png);
    png_set_strip_alpha(png);
    if (deep) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    picture.width = static_cast<int>(png_get_image_width(png, info));
    picture.height = static_cast<int>(png_get_image_height(png, info));
    picture.bits = deep ? 16 : 8;
    channels = png_get_channels(png, info);
    return true;
  }

  /// Reads all rows and what follows them, to the end of the file's last chunk.
  bool finish(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
  }
};

std::uint16_t luminance(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return static_cast<std::uint16_t>((2126 * r + 7152 * g + 722 * b + 5000) / 10000);
}

/// One number of the rows as libpng leaves them.
std::uint32_t number_at(const std::vector<png_byte>& bytes, std::size_t n, int bits) {
  if (bits == 8) return bytes[n];
  std::uint16_t value = 0;
  std::memcpy(&value, &bytes[2 * n], sizeof(value));
  return value;
}

// No destructors in here, as above.
bool encode(std::FILE* file, const GreyPicture& picture, png_bytep row) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, stay_silent);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height),
               picture.bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < picture.height; ++y) {
    png_bytep to = row;
    for (int x = 0; x < picture.width; ++x) {
      const unsigned value = picture.at(x, y);
      if (picture.bits == 16) *to++ = static_cast<png_byte>(value >> 8);
      *to++ = static_cast<png_byte>(value & 0xffU);
    }
    png_write_row(png, row);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

GreyPicture read_grey_png(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path + ": no such file; give a PNG picture");
  const File file(std::filesystem::is_regular_file(path, error) ? std::fopen(path.c_str(), "rb") : nullptr);
  if (!file) throw InputError(path + ": cannot be read; give a PNG picture and check its permissions");
  std::array<png_byte, 8> signature{};
  const std::size_t n_read = std::fread(signature.data(), 1, signature.size(), file.get());
  if (n_read < signature.size() || png_sig_cmp(signature.data(), 0, signature.size()) != 0)
    throw InputError(path + ": is not a PNG picture; convert it to PNG");
  std::rewind(file.get());

  GreyPicture picture;
  Decoder decoder;
  const auto damaged =
      fmt::format("{}: ends early, is damaged, or has more than {} pixels along a side; give a whole PNG",
                  path, most_pixels);
  if (!decoder.begin(file.get(), picture)) throw InputError(damaged);
  const auto width = static_cast<std::size_t>(picture.width),
             height = static_cast<std::size_t>(picture.height);
  const auto channels = static_cast<std::size_t>(decoder.channels);
  const std::size_t row_bytes = width * channels * static_cast<std::size_t>(picture.bits) / 8;
  std::vector<png_byte> bytes(row_bytes * height);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < height; ++y) rows.push_back(&bytes[y * row_bytes]);
  if (!decoder.finish(rows.data())) throw InputError(damaged);

  picture.value.resize(width * height);
  for (std::size_t n = 0; n < picture.value.size(); ++n) {
    const auto number = [&](std::size_t c) { return number_at(bytes, n * channels + c, picture.bits); };
    picture.value[n] =
        channels == 1 ? static_cast<std::uint16_t>(number(0)) : luminance(number(0), number(1), number(2));
  }
  return picture;
}

void write_grey_png(const GreyPicture& picture, const std::string& path) {
  PALPATE_CHECK(picture.width > 0 && picture.height > 0 && (picture.bits == 8 || picture.bits == 16),
                "a picture of 8 or 16 bits");
  const std::string beside = path + ".part";
  std::vector<png_byte> row(static_cast<std::size_t>(picture.width) * 2);
  bool written = false;
  std::string why = "disk full?";
  {
    const File file(open_new(beside));
    if (!file) why = std::strerror(errno);
    written = file && encode(file.get(), picture, row.data()) && std::fflush(file.get()) == 0;
  }
  std::error_code error;
  if (written) std::filesystem::rename(beside, path, error);
  if (written && !error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  throw InputError(path + ": cannot write the picture (" + (error ? error.message() : why) +
                   "); choose a folder that can be written to");
}

}  // namespace palpate
