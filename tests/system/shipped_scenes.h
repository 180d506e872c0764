#pragma once
// Runs the scenes that come with palpate, each of which has to account for its energy.

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/shell.h"

namespace palpate::test {

class ShippedScenes : public CommandRun {
 protected:
  nlohmann::json simulate(const std::string& scene, const std::string& more) {
    const std::filesystem::path out = folder / scene;
    EXPECT_EQ(palpate("simulate " + quoted(SCENES "/" + std::string(scene) + ".toml") +
                      " --no-frames --out " + out.string() + " " + more),
              0)
        << log;
    const auto summary = read_json((out / "summary.json").string());
    EXPECT_GT(summary["energy"]["exchanged"].get<double>(), 0) << scene;
    EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01) << scene;
    EXPECT_EQ(summary["guard"]["restored"].get<int>(), 0) << scene;
    return summary;
  }
  /// Of a patient's labelled abdomen.
  void import_part(const std::string& part, const std::string& file) {
    if (!std::filesystem::exists(LIVER))
      throw std::runtime_error("fetch the liver with deploy/fetch_liver.sh");
    const std::string of = "import " + quoted(LIVER) + " --keep " + part;
    EXPECT_EQ(palpate(of + " --out " + quoted(file)), 0) << log;
  }
};

}  // namespace palpate::test
