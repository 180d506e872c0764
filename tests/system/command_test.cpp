// What a person sees who types `palpate ...`: lines and exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "tests/system/shell.h"

namespace palpate {
namespace {

using testing::HasSubstr;

struct Answer {
  int exit_code = -1;
  std::string text;  // stdout and stderr
};

Answer palpate_says(const std::string& arguments) {
  Answer answer;
  std::FILE* pipe = popen((test::quoted(PALPATE) + " " + arguments + " 2>&1").c_str(), "r");
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    answer.text += static_cast<char>(letter);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  return answer;
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
  expect_mistake("info " + test::quoted(PALPATE), "is no file of palpate; give a volume");
  expect_mistake("plot /no/such/folder", "/no/such/folder: has no summary.json");
}

TEST(Command, RefusesTimesThatNeverEnd) {
  for (const char* seconds : {"nan", "inf", "1e300", "-1", "0"})
    for (const char* option : {"run a.toml --seconds=", "simulate a.toml --seconds=", "replay a.h5 --until="})
      expect_mistake(option + std::string(seconds), "is out of range; write a number above 0 and at most 1000000");
}

TEST(Command, HelpsWithExitCodeZero) {
  for (const char* arguments : {"--help", "run --help", "info --help", "plot --help", "doctor --help"}) {
    const Answer answer = palpate_says(arguments);
    EXPECT_EQ(answer.exit_code, 0) << arguments;
    EXPECT_THAT(answer.text, HasSubstr("--help")) << arguments;
  }
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
