// Every scene that comes along has exactly the remarks that are expected of it: none. And a mistake is said by every command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* head = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";

const std::map<std::string, std::string> expected = {};  // scene: the remarks that it means to have

class RemarksOfScenes : public CommandRun {
 protected:
  void SetUp() override {
    CommandRun::SetUp();
    fs::copy(SCENES, folder / "scenes");
    fs::create_directory(folder / "data");
  }
  std::string remarks_in_log() const {
    std::istringstream lines(log);
    std::string text;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("remark ")) text += line + "\n";
    return text;
  }
};

TEST_F(RemarksOfScenes, ThatComeAlongAreAsExpected) {
  const std::string data = (folder / "data").string();
  ASSERT_EQ(palpate("import --phantom aneurysm --out " + test::quoted(data + "/aneurysm.h5")), 0) << log;
  ASSERT_EQ(palpate("import --phantom brain --out " + test::quoted(data + "/brain")), 0) << log;
  ASSERT_EQ(palpate("import --phantom lobe --out " + test::quoted(data + "/lobe.msh")), 0) << log;
  ASSERT_TRUE(fs::exists(head)) << "install the Debian package invesalius-examples";
  ASSERT_EQ(palpate(std::string("import ") + head + " --out " + test::quoted(data + "/cranium.h5")), 0)
      << log;
  ASSERT_TRUE(fs::exists(LIVER)) << "fetch it with deploy/fetch_liver.sh";
  ASSERT_EQ(palpate(std::string("import ") + test::quoted(LIVER) +
                    " --keep 255,255 --tetrahedra-mm 9.7 --out " + test::quoted(data + "/liver.h5")),
            0)
      << log;
  ASSERT_EQ(
      palpate(std::string("import ") + test::quoted(LIVER) +
              " --keep 85,85 --tetrahedra-mm 4 --largest --out " + test::quoted(data + "/gall_bladder.h5")),
      0)
      << log;
  ASSERT_EQ(palpate(std::string("import ") + test::quoted(LIVER) +
                    " --keep 255,255 --tetrahedra-mm 17 --out " + test::quoted(data + "/liver_coarse.h5")),
            0)
      << log;
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(folder / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    EXPECT_EQ(palpate("info " + test::quoted(entry.path())), 0) << log;
    const auto known = expected.find(entry.path().stem().string());
    EXPECT_EQ(remarks_in_log(), known == expected.end() ? "" : known->second) << entry.path();
  }
  EXPECT_GE(scenes, 43);
}

TEST_F(RemarksOfScenes, AreSaidByInfoAndSimulateAndKeptInTheSummary) {
  const std::string scene = (folder / "scenes" / "box_press.toml").string(), out = (folder / "out").string();
  const char* words = "tool \"tip\" begins inside tissue";
  const std::string inside = " --set 'device.hand.waypoints=[[0,0,0,15],[1,0,0,10]]'";
  EXPECT_EQ(palpate("simulate " + test::quoted(scene) + inside + " --no-frames --seconds 0.05 --out " +
                    test::quoted(out)),
            0)
      << log;
  EXPECT_THAT(log, HasSubstr(words));
  const auto summary = read_json(out + "/summary.json");
  ASSERT_EQ(summary["warnings"].size(), 1u) << summary["warnings"];
  EXPECT_THAT(summary["warnings"][0].get<std::string>(), HasSubstr(words));
  std::ifstream in(scene);
  std::string text(std::istreambuf_iterator<char>(in), {});
  const auto at = text.find("[[0.0, 0, 0, 24]");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 16, "[[0.0, 0, 0, 14]");
  std::ofstream(folder / "scenes" / "near.toml") << text;
  EXPECT_EQ(palpate("info " + test::quoted(folder / "scenes" / "near.toml")), 0) << log;
  EXPECT_THAT(remarks_in_log(), HasSubstr(words));
  EXPECT_EQ(palpate("simulate " + test::quoted(folder / "scenes" / "near.toml") +
                    " --no-frames --seconds 1 --out " + test::quoted(folder / "near")),
            0)
      << log;
  EXPECT_THAT(
      log, HasSubstr("tip: its motors never came on: inside the tissue, move out; let its path begin clear"));
}

/// Its masses, memory and speed cannot be told without.
TEST_F(RemarksOfScenes, AreNotMadeOfASceneWhoseImageIsNotThere) {
  EXPECT_EQ(palpate("info " + test::quoted(folder / "scenes" / "head_press.toml")), 2);
  EXPECT_THAT(log, HasSubstr("head_press.toml:20:14: there is no file"));
  EXPECT_THAT(log, HasSubstr("make it with \"palpate import"));
}

}  // namespace
}  // namespace palpate
