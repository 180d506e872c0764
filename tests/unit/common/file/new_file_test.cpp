// Nothing that palpate writes goes through a link, and nothing of an older file remains.
#include "common/file/new_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "common/record/hdf5_file.h"
#include "common/record/part_file.h"
#include "common/record/png_file.h"
#include "common/report/json_file.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Writer {
  std::string name;
  std::string at;  // file of the folder that is planted as a link
  std::function<void(const std::string& folder)> write;
};

void PrintTo(const Writer& writer, std::ostream* to) { *to << writer.name; }

std::vector<Writer> writers() {
  const auto grey = [](const std::string& folder) {
    write_grey_png({.width = 1, .height = 1, .bits = 8, .value = {7}}, folder + "/a.png");
  };
  const auto part = [](const std::string& folder) {
    PartFile file(folder + "/a");
    std::ofstream(file.part()) << "new";
    file.commit();
  };
  return {
      {"New", "a", [](const std::string& f) { std::fclose(open_new(f + "/a")); }},
      {"Record", "a.h5", [](const std::string& f) { Hdf5File(f + "/a.h5", Hdf5File::Mode::record); }},
      {"Create", "a.h5", [](const std::string& f) { Hdf5File(f + "/a.h5", Hdf5File::Mode::create); }},
      {"Json", "a.json", [](const std::string& f) { write_json(f + "/a.json", {}); }},
      {"Picture", "a.png", grey},
      {"PartOfAPicture", "a.png.part", grey},
      {"Part", "a", part},
      {"PartBeside", "a.part", part},
  };
}

class Links : public testing::TestWithParam<Writer> {};

TEST_P(Links, AreReplacedAndNotFollowed) {
  const ScratchFolder folder;
  const std::string mine = folder / "mine", link = folder / GetParam().at;
  for (const bool there : {true, false}) {  // a link into nowhere is one, too
    if (there) std::ofstream(mine) << "mine";
    fs::remove(link);
    fs::create_symlink(mine, link);
    GetParam().write(folder.path());
    EXPECT_FALSE(fs::is_symlink(link));
    EXPECT_EQ(fs::exists(mine), there);
    EXPECT_EQ(text_of(mine), there ? "mine" : "");
    fs::remove(mine);
  }
}

INSTANTIATE_TEST_SUITE_P(Writers, Links, testing::ValuesIn(writers()),
                         [](const auto& each) { return each.param.name; });

TEST(NewFile, HasNothingOfAnOlderOne) {
  const ScratchFolder folder;
  const std::string path = folder / "a";
  std::ofstream(path) << "old";
  ASSERT_EQ(chmod(path.c_str(), 0666), 0);
  const mode_t before = umask(0077);
  std::fclose(open_new(path));
  umask(before);
  struct stat facts {};
  ASSERT_EQ(stat(path.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  EXPECT_EQ(facts.st_size, 0);
}

TEST(NewFile, LeavesAFolderAlone) {
  const ScratchFolder folder;
  fs::create_directory(folder / "a");
  EXPECT_EQ(open_new(folder / "a"), nullptr);
  EXPECT_TRUE(fs::is_directory(folder / "a"));
  EXPECT_EQ(open_new(folder / "none/a"), nullptr);
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace palpate
