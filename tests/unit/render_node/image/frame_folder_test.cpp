// Frames keep to their budget, and to themselves.
#include "render_node/image/frame_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/record/png_file.h"
#include "common/scene/render_spec.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::render {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

Image grey(int value) {
  const auto v = static_cast<std::uint8_t>(value);
  return {1, 1, {v, v, v}};
}

RenderSpec budget(int frames, double bytes = 1e9) {
  RenderSpec spec;
  spec.most_frames = frames;
  spec.most_frame_bytes = bytes;
  return spec;
}

/// Offers pictures first ... first + n - 1; each bears its number as its shade.
void offer(FrameFolder& frames, int first, int n) {
  for (int i = first; i < first + n; ++i)
    if (frames.wants_next()) frames.keep(grey(i));
  frames.settle();
}

/// The shades of frame_00001.png and so on, as many as there are without a gap.
std::vector<int> shades(const fs::path& out) {
  std::vector<int> found;
  for (int n = 1; fs::exists(out / "frames" / frame_name(n)); ++n)
    found.push_back(read_grey_png((out / "frames" / frame_name(n)).string()).value.at(0));
  return found;
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(FrameFolder, KeepsToItsBudgetAndStaysEven) {
  for (const int n : {7, 8, 9, 10, 17, 33, 64, 100, 250}) {
    const ScratchFolder out;
    FrameFolder frames(out.path(), budget(8));
    for (int i = 0; i < n; ++i) {
      offer(frames, i, 1);
      ASSERT_LE(files_in(fs::path(out.path()) / "frames"), 8u) << n;
    }
    const auto left = shades(out.path());
    EXPECT_EQ(left.size(), files_in(fs::path(out.path()) / "frames")) << "numbered without a gap";
    if (n >= 8) {
      EXPECT_GE(left.size(), 4u) << n;
    }
    const int step = left.at(1);
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_EQ(left[i], static_cast<int>(i) * step) << n;
    EXPECT_EQ(frames.kept(), left.size());
    EXPECT_EQ(frames.left_out(), static_cast<std::size_t>(n) - left.size()) << n;
    EXPECT_EQ(frames.every(), static_cast<std::uint64_t>(step)) << n;
  }
}

/// Whoever draws does not wait for a picture to be written, and nothing of what was kept is lost by going.
TEST(FrameFolder, WritesBesideAndInOrder) {
  const ScratchFolder out;
  {
    FrameFolder frames(out.path(), budget(8));
    for (int i = 0; i < 40; ++i) {
      if (frames.wants_next()) frames.keep(grey(i));
      ASSERT_LE(files_in(fs::path(out.path()) / "frames"), 8u) << i;
    }
  }
  const auto left = shades(out.path());
  ASSERT_GE(left.size(), 4u);
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_EQ(left[i], static_cast<int>(i) * left[1]);
}

TEST(FrameFolder, CountsBytes) {
  const ScratchFolder out;
  FrameFolder first(out.path(), budget(1000));
  offer(first, 0, 1);
  const auto bytes = static_cast<double>(fs::file_size(out / "frames/frame_00001.png"));
  FrameFolder frames(out.path(), budget(1000, 5.5 * bytes));
  offer(frames, 1, 100);
  EXPECT_LE(shades(out.path()).size(), 6u);
  EXPECT_GE(shades(out.path()).size(), 3u);
}

TEST(FrameFolder, GoesOnAfterItsOwnOfBefore) {
  const ScratchFolder out;
  for (int start = 0; start < 3; ++start) {
    FrameFolder frames(out.path(), budget(8));
    offer(frames, 4 * start, 4);
  }
  EXPECT_THAT(shades(out.path()), testing::ElementsAre(0, 2, 4, 6, 8, 10));
}

TEST(FrameFolder, LeavesWhatAPersonPutThereAlone) {
  const ScratchFolder out;
  fs::create_directories(out / "frames");
  const std::vector<std::string> names = {"frame_00001.png", "frame_00003.png", "frame_2.png", "holiday.png",
                                          "notes.txt"};
  for (const auto& name : names) std::ofstream(out / ("frames/" + name)) << "mine " << name;
  FrameFolder frames(out.path(), budget(4));
  offer(frames, 0, 50);
  EXPECT_LE(own_pictures(out / "frames").size(), 4u);
  for (const auto& name : names) {
    std::string text;
    std::ifstream in(out / ("frames/" + name));
    std::getline(in, text);
    EXPECT_EQ(text, "mine " + name);
  }
}

TEST(FrameFolder, RefusesALink) {
  const ScratchFolder out;
  fs::create_directories(out / "elsewhere");
  fs::create_symlink(out / "elsewhere", out / "frames");
  EXPECT_THROW(FrameFolder(out.path(), budget(4)), InputError);
}

TEST(OwnPicture, IsKnownByItsNameAndItsMark) {
  EXPECT_EQ(frame_number(frame_name(12)), 12);
  EXPECT_EQ(frame_number("frame_123456.png"), 123456);
  for (const char* name :
       {"frame_12.png", "frame_000012.png", "frame_00000.png", "frame_-0012.png", "frame_.png", "frame_png",
        "frame_00012.png.part", "xframe_00012.png", "frame_99999999999.png", "Frame_00012.png"})
    EXPECT_EQ(frame_number(name), std::nullopt) << name;
  const ScratchFolder folder;
  write_png(grey(1), folder / "frame_00001.png");
  write_grey_png({.width = 1, .height = 1, .bits = 8, .value = {7}}, folder / "frame_00002.png");
  std::ofstream(folder / "frame_00003.png") << "short";
  fs::create_symlink(folder / "frame_00001.png", folder / "frame_00004.png");
  fs::create_directory(folder / "frame_00005.png");
  const auto own = own_pictures(folder.path());
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].number, 1);
  EXPECT_EQ(own[0].bytes, fs::file_size(folder / "frame_00001.png"));
}

}  // namespace
}  // namespace palpate::render
