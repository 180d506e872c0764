#pragma once
// `palpate` on the shipped scene of a pressed box, with the drivers and settings of a test, in a folder of its own.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/system/shell.h"

namespace palpate::test {

namespace fs = std::filesystem;

class DriverRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "palpate_driver_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  /// `palpate WORDS scenes/box_press.toml --out folder/NAME MORE`. @return exit code
  int palpate(const std::string& words, const std::string& name, const std::string& more) const {
    const std::string command = quoted(PALPATE) + " " + words + " " + quoted(SCENES "/box_press.toml") +
                                " --out " + quoted(folder / name) + " " + more + " >" +
                                quoted(folder / (name + ".log")) + " 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said(const std::string& name) const {
    std::ifstream file(folder / (name + ".log"));
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// Height of the tip and force on it, by the frames of physics.
  std::vector<std::pair<double, double>> trace(const std::string& name) const {
    std::ifstream file(folder / name / "tool_tip.csv");
    std::vector<std::pair<double, double>> rows;
    for (std::string line; std::getline(file, line);) {
      double t = 0, x = 0, y = 0, z = 0, fx = 0, fy = 0, fz = 0;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t, &x, &y, &z, &fx, &fy, &fz) == 7)
        rows.emplace_back(z, fz);
    }
    return rows;
  }
  double peak(const std::string& name) const {
    double most = 0;
    for (const auto& [z, force] : trace(name)) most = std::max(most, force);
    return most;
  }

  fs::path folder;
};

}  // namespace palpate::test
