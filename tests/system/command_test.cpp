// What a person sees who types `palpate ...`: lines and exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

struct Answer {
  int exit_code = -1;
  std::string text;  // stdout and stderr
};

Answer answer_of(const std::string& command) {
  Answer answer;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    answer.text += static_cast<char>(letter);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  return answer;
}

Answer palpate_says(const std::string& arguments) {
  return answer_of(test::quoted(PALPATE) + " " + arguments);
}

void expect_mistake(const std::string& arguments, const std::string& words) {
  const Answer answer = palpate_says(arguments);
  EXPECT_EQ(answer.exit_code, 2) << arguments;
  EXPECT_THAT(answer.text, HasSubstr(words)) << arguments;
  EXPECT_EQ(answer.text.find('\n'), answer.text.size() - 1) << "one line: " << answer.text;
}

TEST(Command, AnswersAMistakeWithOneLineAndExitCodeTwo) {
  expect_mistake("", "give a subcommand");
  expect_mistake("frob", "frob");
  expect_mistake("run", "scene is required");
  expect_mistake("run /no/such/scene.toml", "/no/such/scene.toml: no such file");
  expect_mistake("info", "file is required");
  expect_mistake("info /no/such/file.h5", "/no/such/file.h5: no such file");
  expect_mistake("info /dev/zero", "/dev/zero: is a device, not a file");
  expect_mistake("info /tmp", "/tmp: is a folder; give a volume");
  expect_mistake("info " + test::quoted(PALPATE), "is no file of palpate; give a volume");
  expect_mistake("plot /no/such/folder", "/no/such/folder: has no summary.json");
}

TEST(Command, RefusesTimesThatNeverEnd) {
  for (const char* seconds : {"nan", "inf", "1e300", "-1", "0"})
    for (const char* option : {"run a.toml --seconds=", "simulate a.toml --seconds=", "replay a.h5 --until="})
      expect_mistake(option + std::string(seconds),
                     "is out of range; write a number above 0 and at most 1000000");
}

TEST(Command, MakesNoFilmWithoutFfmpegNorOfAWindow) {
  const fs::path out = fs::path(testing::TempDir()) / ("palpate_film_" + std::to_string(getpid()));
  const std::string rest = test::quoted(fs::path(SCENES) / "box_press.toml") + " --out " + test::quoted(out) +
                           " --video " + test::quoted(out.string() + ".mp4");
  for (const char* words : {" simulate ", " run --headless "}) {
    const Answer answer = answer_of("PATH=/nowhere " + test::quoted(PALPATE) + words + rest);
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_THAT(answer.text, HasSubstr("no ffmpeg is installed")) << words;
  }
  const Answer windowed = answer_of("DISPLAY=:98765 " + test::quoted(PALPATE) + " run " + rest);
  EXPECT_EQ(windowed.exit_code, 2);
  EXPECT_THAT(windowed.text, HasSubstr("without a window; add --headless"));
  EXPECT_FALSE(fs::exists(out)) << "nothing was begun";
}

TEST(Command, HelpsWithExitCodeZero) {
  for (const char* arguments : {"--help", "run --help", "info --help", "plot --help", "doctor --help"}) {
    const Answer answer = palpate_says(arguments);
    EXPECT_EQ(answer.exit_code, 0) << arguments;
    EXPECT_THAT(answer.text, HasSubstr("--help")) << arguments;
  }
}

TEST(Command, SaysWhichVersionItIs) {
  for (const char* program :
       {"palpate", "palpate-physics", "palpate-haptic", "palpate-render", "palpate-import"}) {
    const Answer answer = answer_of(test::quoted(std::string(BIN) + "/" + program) + " --version");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_THAT(answer.text, testing::MatchesRegex(std::string(program) +
                                                   " [0-9]+\\.[0-9]+\\.[0-9]+ \\(commit [^)]+\\)\n"));
  }
}

TEST(Command, SaysWhatWasProbablyMeant) {
  const std::string scene = test::quoted(std::string(SCENES) + "/box_press.toml");
  expect_mistake("rum " + scene + " --headless", "there is no command \"rum\"; did you mean \"run\"?");
  expect_mistake("frobnicate", "there is no command \"frobnicate\"; commands: \"run\"");
  expect_mistake("run --headles " + scene,
                 "there is no option --headles; did you mean --headless?; see palpate run --help");
  expect_mistake("simulate " + scene + " --secnds=2", "there is no option --secnds; did you mean --seconds?");
  expect_mistake("--versoin", "there is no option --versoin; did you mean --version?");
  expect_mistake("info " + scene + " " + scene, "box_press.toml\" is one word too many");
  expect_mistake("run " + scene + " --deployment p9", "there is no \"p9\"; write \"all\", \"p2\" or \"p3\"");
  expect_mistake("run " + scene + " --headless --device simulatd",
                 "no driver \"simulatd\"; did you mean \"simulated\"?");
  expect_mistake("simulate " + scene + " --device simulatd", "did you mean \"simulated\"?");
  expect_mistake("simulate " + scene + " --set device.hand.driver=simulatd", "did you mean \"simulated\"?");
  expect_mistake("simulate " + scene + " --set body.block.material=sft", "did you mean \"soft\"?");
  expect_mistake("simulate " + scene + " --set body.block.shape=sphre", "did you mean \"sphere\"?");
  expect_mistake("simulate " + scene + " --set tool.tip.shape=stik", "did you mean \"stick\"?");
  expect_mistake("simulate " + scene + " --set physics.integrator=velocity_verlett",
                 "did you mean \"velocity_verlet\"?");
  expect_mistake("import --phantom aneurism --out v.h5", "did you mean \"aneurysm\"?");
  const Answer node =
      answer_of(test::quoted(std::string(BIN) + "/palpate-physics") + " " + scene + " --domian 3");
  EXPECT_EQ(node.exit_code, 2);
  EXPECT_THAT(node.text, HasSubstr("there is no option --domian; did you mean --domain?"));
  EXPECT_EQ(node.text.find('\n'), node.text.size() - 1) << node.text;
}

TEST(Command, RefusesAnOutputNameThatLiesAboutItsFormat) {
  expect_mistake("import --phantom aneurysm --out /nowhere/V.nii.gz", "write --out /nowhere/V.h5");
  expect_mistake("import --phantom aneurysm --out V", "write --out V.h5");
  expect_mistake("import --phantom brain --out brain.h5", "brain.h5: slices are PNG files in a folder");
  expect_mistake("import --phantom lobe --out lobe.stl", "write --out lobe.h5");
}

/// A session of palpate's, as far as plots need one.
class Folder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "palpate_command_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  void write(const std::string& name, const std::string& text, bool program = false) const {
    std::ofstream(folder / name) << text;
    if (program) fs::permissions(folder / name, fs::perms::owner_all);
  }
  fs::path folder;
};

TEST_F(Folder, PlotSaysWhereItWrote) {
  write("summary.json", R"({"tools": {"tip": {"trace": "tool_tip.csv"}}})");
  write("tool_tip.csv",
        "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,contacts\n0,0,0,0,0,0,1,0,0,0,1\n1,0,0,0,0,0,2,0,0,"
        "0,1\n");
  const Answer drawn = palpate_says("plot " + folder.string());
  EXPECT_EQ(drawn.exit_code, 0);
  EXPECT_EQ(drawn.text, "plot     " + (folder / "force.png").string() + "\n");
  EXPECT_TRUE(fs::exists(folder / "force.png"));
  fs::remove(folder / "force.png");
  write("summary.json", "{}");
  EXPECT_THAT(palpate_says("plot " + folder.string()).text, HasSubstr("plot     none"));
}

/// A made Debian in which installing takes a while.
TEST_F(Folder, InstallingPackagesShowsThatItGoesOn) {
  write("apt-get",
        "#!/bin/bash\nfor n in 1 2 3 4 5 6 7 8; do echo \"Unpacking number $n\"; sleep 0.5; done\n", true);
  write("dpkg-query", "#!/bin/bash\necho not-installed\n", true);
  write("sudo", "#!/bin/bash\nexec \"$@\"\n", true);
  write("list", "a-package  # of which nobody has heard\n");
  const std::string path = "PATH=" + folder.string() + ":$PATH ";
  const Answer answer =
      answer_of(path + "PALPATE_LINE_EVERY_S=1 " + test::quoted(DEPLOY "/install_packages.sh") + " " +
                (folder / "list").string());
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, testing::ContainsRegex("packages: [0-9]+ s  Unpacking number [0-9]"));
  write("apt-get", "#!/bin/bash\necho 'E: no network'; exit 100\n", true);
  const Answer failed =
      answer_of(path + test::quoted(DEPLOY "/install_packages.sh") + " " + (folder / "list").string());
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_THAT(failed.text, HasSubstr("apt-get update failed: E: no network"));
}

TEST(Command, HandsImportOverToTheImporter) {
  const Answer answer = palpate_says("import --help");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("--out"));
}

TEST(Doctor, SaysOneLineAboutEachThing) {
  setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // the system's EGL library keeps some bytes
  const Answer answer = palpate_says("doctor");
  for (const char* name : {"nodes", "DDS", "GL", "driver", "plots", "processor", "timer", "real time",
                           "memory lock", "shared memory"}) {
    EXPECT_THAT(answer.text, HasSubstr(" " + std::string(name) + " ")) << name;
  }
  for (const char* driver :
       {"simulated", "replay", "openhaptics", "forcedimension", "inverse3", "spacenav", "openigtlink"})
    EXPECT_THAT(answer.text, HasSubstr(" " + std::string(driver) + ": ")) << driver;
  EXPECT_THAT(answer.text, HasSubstr("messages pass, and only this machine is heard"));
  const bool fails = answer.text.rfind("fails", 0) == 0 || answer.text.find("\nfails") != std::string::npos;
  EXPECT_EQ(answer.exit_code, fails ? 1 : 0) << answer.text;
}

TEST(Doctor, LetsEachDriverSayWhatItLacks) {
  setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  const Answer answer = palpate_says("doctor");
  EXPECT_THAT(answer.text, HasSubstr("driver         simulated: ready; id = \"simulated\""));
  const std::pair<const char*, const char*> lacking[] = {
      {"openhaptics", "the library of OpenHaptics does not load (libHD.so: cannot open shared object file"},
      {"forcedimension",
       "the library of Force Dimension does not load (libdhd.so: cannot open shared object file"},
      {"inverse3", "no Haply Inverse service at ws://localhost:10001 (Connection refused)"}};
  for (const auto& [driver, words] : lacking) {
    // a machine with the vendor's software is ready
    const bool ready = answer.text.find(std::string(driver) + ": ready") != std::string::npos;
    if (!ready) {
      EXPECT_THAT(answer.text, HasSubstr(std::string(driver) + ": " + words));
    }
  }
}

}  // namespace
}  // namespace palpate
