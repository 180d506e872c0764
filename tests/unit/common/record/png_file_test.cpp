// Every kind of PNG becomes the right shades of grey, or one line that says why not.
#include "common/record/png_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "common/error/error.h"
#include "common/record/slice_stack.h"
#include "common/scene/shape_spec.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/made_png.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

template <class Act>
std::string complaint(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.complaints().size() == 1 ? error.complaints()[0] : "several";
  }
  return "none";
}
std::string read_complaint(const std::string& path) {
  return complaint([&] { read_grey_png(path); });
}

struct KindCase {
  PngRecipe recipe;
  std::function<double(int, int)> grey;  // what it should become
};
void PrintTo(const KindCase& c, std::ostream* out) {
  *out << "kind " << static_cast<int>(c.recipe.kind) << " bits " << c.recipe.bits << " interlaced "
       << c.recipe.interlaced;
}

/// A different value in every pixel and channel.
unsigned value_of(int x, int y, int c) { return static_cast<unsigned>(7 * x + 31 * y + 50 * c + 1); }
unsigned deep_value_of(int x, int y, int c) { return 130U * value_of(x, y, c) + 13; }
double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

class PngKinds : public testing::TestWithParam<std::tuple<KindCase, bool>> {};

TEST_P(PngKinds, BecomeGrey) {
  const ScratchFolder folder;
  auto [kind, interlaced] = GetParam();
  PngRecipe recipe = kind.recipe;
  recipe.width = 13;
  recipe.height = 9;
  recipe.interlaced = interlaced;
  const unsigned most = (1U << recipe.bits) - 1;
  make_png(folder / "a.png", recipe, [&](int x, int y, int c) {
    return recipe.bits == 16 ? deep_value_of(x, y, c) : value_of(x, y, c) & most;
  });
  const GreyPicture picture = read_grey_png(folder / "a.png");
  ASSERT_EQ(picture.width, 13);
  ASSERT_EQ(picture.height, 9);
  EXPECT_EQ(picture.bits, recipe.bits == 16 ? 16 : 8);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 13; ++x) ASSERT_NEAR(picture.at(x, y), kind.grey(x, y), 0.5001) << x << ", " << y;
}

const std::vector<KindCase> kinds = {
    {{.kind = PngKind::grey, .bits = 8}, [](int x, int y) { return value_of(x, y, 0) & 255U; }},
    {{.kind = PngKind::grey, .bits = 16}, [](int x, int y) { return deep_value_of(x, y, 0); }},
    {{.kind = PngKind::grey, .bits = 4}, [](int x, int y) { return 17 * (value_of(x, y, 0) & 15U); }},
    {{.kind = PngKind::grey, .bits = 2}, [](int x, int y) { return 85 * (value_of(x, y, 0) & 3U); }},
    {{.kind = PngKind::grey, .bits = 1}, [](int x, int y) { return 255 * (value_of(x, y, 0) & 1U); }},
    {{.kind = PngKind::grey_alpha, .bits = 8}, [](int x, int y) { return value_of(x, y, 0) & 255U; }},
    {{.kind = PngKind::rgb, .bits = 8},
     [](int x, int y) {
       return luminance(value_of(x, y, 0) & 255U, value_of(x, y, 1) & 255U, value_of(x, y, 2) & 255U);
     }},
    {{.kind = PngKind::rgb_alpha, .bits = 16},
     [](int x, int y) {
       return luminance(deep_value_of(x, y, 0), deep_value_of(x, y, 1), deep_value_of(x, y, 2));
     }},
    {{.kind = PngKind::palette, .bits = 8},
     [](int x, int y) {
       const unsigned n = value_of(x, y, 0) & 255U;
       return luminance(n, 2 * n & 255U, 3 * n & 255U);
     }},
    {{.kind = PngKind::palette, .bits = 4},
     [](int x, int y) {
       const unsigned n = value_of(x, y, 0) & 15U;
       return luminance(n, 2 * n, 3 * n);
     }},
};
INSTANTIATE_TEST_SUITE_P(Png, PngKinds, testing::Combine(testing::ValuesIn(kinds), testing::Bool()));

TEST(PngFile, KeepsEqualChannelsAsTheyAre) {
  const ScratchFolder folder;
  make_png(folder / "a.png", {.width = 256, .height = 1, .kind = PngKind::rgb},
           [](int x, int, int) { return static_cast<unsigned>(x); });
  const GreyPicture picture = read_grey_png(folder / "a.png");
  for (int x = 0; x < 256; ++x) EXPECT_EQ(picture.at(x, 0), x);
}

TEST(PngFile, ComesBackAsWritten) {
  const ScratchFolder folder;
  for (const int bits : {8, 16}) {
    GreyPicture picture{7, 3, bits, {}};
    for (int n = 0; n < 21; ++n)
      picture.value.push_back(static_cast<std::uint16_t>(bits == 8 ? 12 * n : 3000 * n + 7));
    write_grey_png(picture, folder / "a.png");
    const GreyPicture back = read_grey_png(folder / "a.png");
    EXPECT_EQ(back.value, picture.value);
    EXPECT_EQ(back.bits, bits);
  }
  EXPECT_THAT(complaint([&] {
                write_grey_png({1, 1, 8, {0}}, folder / "none/a.png");
              }),
              HasSubstr("cannot write the picture"));
}

TEST(PngFile, RefusesWhatIsNone) {
  const ScratchFolder folder;
  EXPECT_EQ(read_complaint(folder / "none.png"),
            folder / "none.png" + std::string(": no such file; give a PNG picture"));
  EXPECT_THAT(read_complaint(folder.path()), HasSubstr(": cannot be read; give a PNG picture"));
  write_file(folder / "empty.png", "");
  write_file(folder / "text.png", "this is a picture of a brain");
  for (const auto* name : {"empty.png", "text.png"})
    EXPECT_EQ(read_complaint(folder / name),
              folder / name + std::string(": is not a PNG picture; convert it to PNG"));
}

/// Every truncation is one complaint; every damaged byte is one, or a picture of the same size (a comment, a text).
TEST(PngFile, SurvivesDamage) {
  const ScratchFolder folder;
  const auto seed = std::random_device{}();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 dice(seed);
  for (const auto kind : {PngKind::grey, PngKind::palette}) {
    make_png(folder / "whole.png", {.width = 20, .height = 20, .kind = kind, .interlaced = true}, value_of);
    const Bytes whole = file_bytes(folder / "whole.png");
    const auto path = folder / "a.png";
    for (std::size_t n = 0; n < whole.size(); ++n) {
      write_file(path, first_bytes(whole, n));
      ASSERT_THAT(read_complaint(path), StartsWith(path + ": ")) << "first " << n << " bytes";
    }
    int refused = 0;
    for (int n = 0; n < 2000; ++n) {
      Bytes damaged = whole;
      const auto at = dice() % whole.size();
      damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + dice() % 255));
      write_file(path, damaged);
      const auto said = read_complaint(path);
      if (said != "none") ++refused;
      ASSERT_TRUE(said == "none" || said.starts_with(path + ": ")) << said;
    }
    EXPECT_GT(refused, 1000) << "checksums find most";
  }
}

TEST(PngFile, RefusesAbsurdSizesBeforeItTakesMemory) {
  const ScratchFolder folder;
  make_png(folder / "wide.png", {.width = most_pixels + 1, .height = 1}, [](int, int, int) { return 0U; });
  EXPECT_THAT(read_complaint(folder / "wide.png"),
              HasSubstr("has more than 8192 pixels along a side; give a whole PNG"));
}

TEST(SliceStack, IsAVolumeThatLooksAsOnTheScreen) {
  const ScratchFolder folder;
  for (int k = 0; k < 2; ++k)
    make_png(folder / fmt::format("{}.png", k), {.width = 3, .height = 2},
             [k](int x, int y, int) { return static_cast<unsigned>(x + 10 * y + 100 * k); });
  const Volume volume = read_slices({folder / "0.png", folder / "1.png"}, {0.001, 0.002, 0.003});
  EXPECT_THAT(volume.size, ElementsAre(3, 2, 2));
  EXPECT_EQ(volume.at(0, 1, 0), 0) << "the first row of a picture is its upper end";
  EXPECT_EQ(volume.at(2, 0, 0), 12);
  EXPECT_EQ(volume.at(2, 0, 1), 112);
  EXPECT_TRUE(volume.spacing.isApprox(Eigen::Vector3d(0.001, 0.002, 0.003)));
  EXPECT_EQ(volume.transfer.back().intensity, 112);
  EXPECT_NE(volume.source_checksum, 0u);
}

TEST(SliceStack, RefusesUnequalSlices) {
  const ScratchFolder folder;
  make_png(folder / "a.png", {.width = 3, .height = 2}, value_of);
  make_png(folder / "wide.png", {.width = 4, .height = 2}, value_of);
  make_png(folder / "deep.png", {.width = 3, .height = 2, .bits = 16}, deep_value_of);
  for (const auto* other : {"wide.png", "deep.png"}) {
    const auto said = complaint([&] {
      read_slices({folder / "a.png", folder / other}, {0.001, 0.001, 0.001});
    });
    EXPECT_THAT(said, StartsWith(folder / other + std::string(": is ")));
    EXPECT_THAT(said, HasSubstr("but the first slice is 3 x 2 of 8; slices of one body must be alike"));
  }
  EXPECT_THAT(complaint([&] {
                read_slices({folder / "a.png"}, {0.001, 0.001, 2});
              }),
              HasSubstr("its spacing is"));
}

}  // namespace
}  // namespace palpate::test
