#pragma once
// `palpate` run in a folder of its own that is gone afterwards.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/system/shell.h"

namespace palpate {

class CommandRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "palpate_scenes_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// `palpate WORDS`, its output in `log`. @return exit code
  int palpate(const std::string& words) {
    const std::filesystem::path file = folder / "log";
    const int status =
        std::system((test::quoted(PALPATE) + " " + words + " >" + test::quoted(file) + " 2>&1").c_str());
    std::ifstream in(file);
    log.assign(std::istreambuf_iterator<char>(in), {});
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder;
  std::string log;
};

}  // namespace palpate
