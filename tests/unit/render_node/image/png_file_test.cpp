#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>

#include "common/error/error.h"
#include "render_node/image/png_file.h"

namespace palpate::render {
namespace {

std::filesystem::path fresh_folder() {
  const auto folder = std::filesystem::path(testing::TempDir()) / "palpate_png_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(PngFile, GivesBackEveryPixel) {
  Image image{7, 5, {}};
  for (int i = 0; i < 7 * 5 * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 2));
  const auto path = fresh_folder() / "a.png";
  write_png(image, path.string());
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&read, path.c_str()), 0);
  EXPECT_EQ(read.width, 7U);
  EXPECT_EQ(read.height, 5U);
  read.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(read));
  ASSERT_NE(png_image_finish_read(&read, nullptr, rgb.data(), 0, nullptr), 0);
  EXPECT_EQ(rgb, image.rgb);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
}

/// Its compression is that of another library than its reader's: pictures of all kinds come back.
TEST(PngFile, GivesBackPicturesOfAllKinds) {
  std::uint32_t noise = 1;
  const auto next = [&noise] { return noise = 1664525 * noise + 1013904223, noise >> 24; };
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 400}, {400, 1}, {640, 480}, {1921, 3}})
    for (const bool is_noise : {false, true}) {
      Image image{width, height, {}};
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < 3 * width; ++x)
          image.rgb.push_back(static_cast<std::uint8_t>(is_noise ? next() : (x / 3 + y) / 4U));
      const auto path = fresh_folder() / "a.png";
      write_png(image, path.string());
      png_image read{};
      read.version = PNG_IMAGE_VERSION;
      ASSERT_NE(png_image_begin_read_from_file(&read, path.c_str()), 0) << read.message;
      read.format = PNG_FORMAT_RGB;
      std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(read));
      ASSERT_NE(png_image_finish_read(&read, nullptr, rgb.data(), 0, nullptr), 0) << read.message;
      EXPECT_EQ(read.warning_or_error, 0U) << read.message;
      EXPECT_EQ(rgb, image.rgb) << width << " x " << height << (is_noise ? " of noise" : "");
    }
}

TEST(PngFile, SaysWhereItCannotWrite) {
  const Image image{1, 1, {1, 2, 3}};
  const auto path = (fresh_folder() / "no_such_folder" / "a.png").string();
  try {
    write_png(image, path);
    FAIL() << "wrote into a folder that does not exist";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
  }
}

TEST(PngFile, LeavesNoPartWhenItCannotRename) {
  const auto folder = fresh_folder();
  const auto taken = folder / "a.png";
  std::filesystem::create_directories(taken / "something");  // a folder of that name cannot be replaced
  EXPECT_THROW(write_png(Image{1, 1, {1, 2, 3}}, taken.string()), InputError);
  EXPECT_FALSE(std::filesystem::exists(taken.string() + ".part"));
}

}  // namespace
}  // namespace palpate::render
