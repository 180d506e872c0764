#include "render_node/image/png_file.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "common/error/error.h"
#include "common/file/new_file.h"

namespace palpate::render {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void complain(const std::string& path, const char* why) {
  throw InputError(path + ": cannot write the picture (" + why + "); choose a folder that can be written to");
}

// Said by write_png(), not by the library.
void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignore(png_structp, png_const_charp) {}

// libpng reports through longjmp, so nothing with a destructor lives in here. @return false: failed
bool encode(std::FILE* file, const Image& image, std::span<const std::uint8_t> packed) {
  static char key[] = "Software", maker[] = "palpate";  // is_own_picture() looks for it
  png_text mark = {};
  mark.compression = PNG_TEXT_COMPRESSION_NONE;
  mark.key = key;
  mark.text = maker;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, &give_up, &ignore);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_text(png, info, &mark, 1);
  png_write_info(png, info);
  static const png_byte idat[] = "IDAT", iend[] = "IEND";
  png_write_chunk(png, idat, packed.data(), packed.size());
  png_write_chunk(png, iend, nullptr, 0);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

void write_png(const Image& image, const std::string& path) { PngWriter().write(image, path); }

void PngWriter::write(const Image& image, const std::string& path) {
  PALPATE_CHECK(image.width > 0 && image.height > 0, "an empty picture cannot be written");
  const std::span<const std::uint8_t> packed = packer_.pack(image);
  const std::string beside = path + ".part";
  bool written = false;
  int why = 0;
  {
    const std::unique_ptr<std::FILE, CloseFile> file(open_new(beside));
    if (!file) complain(path, std::strerror(errno));
    errno = 0;
    written = encode(file.get(), image, packed) && std::fflush(file.get()) == 0;
    why = errno;
  }
  std::error_code error;
  if (written) std::filesystem::rename(beside, path, error);
  if (written && !error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  complain(path, error ? error.message().c_str() : std::strerror(why));
}

}  // namespace palpate::render
