#include "common/scene/file_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FileList, FitsPatterns) {
  EXPECT_TRUE(fits_pattern("slice_01.png", "slice_*.png"));
  EXPECT_TRUE(fits_pattern("slice_.png", "slice_*.png"));
  EXPECT_TRUE(fits_pattern("a.png.png", "*.png"));
  EXPECT_TRUE(fits_pattern("aab", "a?b"));
  EXPECT_TRUE(fits_pattern("", "**"));
  EXPECT_TRUE(fits_pattern("abcabd", "*ab?"));
  EXPECT_FALSE(fits_pattern("slice_01.png", "slice_?.png"));
  EXPECT_FALSE(fits_pattern("slice_01.png.part", "slice_*.png"));
  EXPECT_FALSE(fits_pattern("", "?"));
  EXPECT_FALSE(fits_pattern("ab", ""));
}

TEST(FileList, CountsInNames) {
  EXPECT_TRUE(in_natural_order("slice_2.png", "slice_10.png"));
  EXPECT_FALSE(in_natural_order("slice_10.png", "slice_2.png"));
  EXPECT_TRUE(in_natural_order("slice_009.png", "slice_10.png"));
  EXPECT_TRUE(in_natural_order("a", "a1"));
  EXPECT_TRUE(in_natural_order("a1b2", "a1b10"));
  EXPECT_NE(in_natural_order("s02", "s2"), in_natural_order("s2", "s02")) << "a strict order";
  EXPECT_FALSE(in_natural_order("s2", "s2"));
  EXPECT_TRUE(in_natural_order("s99999999999999999999", "s100000000000000000000"))
      << "however long a number is";
}

TEST(FileList, FindsTheFilesOfAFolder) {
  const auto folder = test::scene_folder() + "/planes";
  std::filesystem::create_directories(folder + "/p_3.png");  // a folder is no file
  for (const auto* name : {"p_10.png", "p_1.png", "p_2.png", "q_1.png", "p_1.txt"})
    std::ofstream(folder + "/" + name) << "x";
  EXPECT_THAT(files_of_pattern(folder + "/p_*.png"),
              ElementsAre(folder + "/p_1.png", folder + "/p_2.png", folder + "/p_10.png"));
  EXPECT_THAT(files_of_pattern(folder + "/q_1.png"), ElementsAre(folder + "/q_1.png"));
  EXPECT_THAT(files_of_pattern(folder + "/p_3.png"), IsEmpty());
  EXPECT_THAT(files_of_pattern(folder + "/none_*"), IsEmpty());
  EXPECT_THAT(files_of_pattern(test::scene_folder() + "/no_folder/*.png"), IsEmpty());
}

}  // namespace
}  // namespace palpate
