// palpate view: pictures of any volume, whole and cut open, and a scene that a window shows.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "common/record/png_file.h"
#include "common/record/volume.h"
#include "common/scene/load_scene.h"
#include "tests/support/image/made_scans.h"
#include "tests/system/command_run.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

using testing::HasSubstr;

class View : public CommandRun {
 protected:
  void SetUp() override {
    CommandRun::SetUp();
    write_volume(test::ct_head().volume, (folder / "my \"head\".h5").string());
  }
  int view(const std::string& more) {
    return palpate("view " + test::quoted(folder / "my \"head\".h5") + " --headless --out " +
                   test::quoted(folder / "seen") + " " + more);
  }
  std::string bytes_of(const std::string& name) const {
    std::ifstream file(folder / "seen" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(View, DrawsItWholeAndCutOpen) {
  ASSERT_EQ(view(""), 0) << log;
  EXPECT_THAT(log, HasSubstr("tissue       intensity"));
  std::set<std::string> pictures;
  for (const char* name : {"front", "side", "coronal", "sagittal", "axial"}) {
    const std::string file = (folder / "seen" / (std::string(name) + ".png")).string();
    const auto picture = read_grey_png(file);
    EXPECT_EQ(picture.width, 1280) << name;
    // Something is there: more than the background's few levels of grey.
    std::set<int> greys(picture.value.begin(), picture.value.end());
    EXPECT_GT(greys.size(), 60u) << name;
    EXPECT_TRUE(pictures.insert(bytes_of(std::string(name) + ".png")).second) << name << " is as one before";
  }
  const Scene scene = load_scene((folder / "seen" / "view.toml").string());
  EXPECT_EQ(scene.title, "my \"head\"");
  ASSERT_EQ(palpate("info " + test::quoted(folder / "seen" / "view.toml")), 0) << log;
  EXPECT_THAT(log, Not(HasSubstr("remark")));
}

TEST_F(View, TakesTheWindowThatIsGiven) {
  ASSERT_EQ(view("--keep 200,3000"), 0) << log;
  EXPECT_THAT(log, HasSubstr("intensity 200 to 3000"));
}

TEST_F(View, SaysWhatIsWrongInOneLine) {
  const auto expect = [&](const std::string& arguments, const std::string& what) {
    EXPECT_EQ(palpate("view " + arguments), 2) << log;
    EXPECT_THAT(log, HasSubstr(what));
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
  };
  expect(test::quoted(folder / "none.h5"), "no such file; give a volume that palpate import has written");
  std::ofstream(folder / "text.h5") << "no volume";
  expect(test::quoted(folder / "text.h5"), "is not an HDF5 file");
  expect(test::quoted(folder / "my \"head\".h5") + " --keep 9,1", "give the lowest intensity first");
  expect(test::quoted(folder / "my \"head\".h5") + " --keep 99998,99999 --headless --out " +
             test::quoted(folder / "seen"),
         "keeps no voxel");
}

}  // namespace
}  // namespace palpate
