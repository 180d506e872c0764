#pragma once
// A small house of its own, where breaches are planted.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "tests/house/house_rules.h"

namespace palpate::house {

class PlantedHouse : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(root_);
    plant("common/math/sum.h", "#pragma once\n#include <vector>\n#include \"common/math/units.h\"\n");
    plant("physics_node/main.cpp", "#include \"common/math/sum.h\"\n#include \"physics_node/body/body.h\"\n");
    ASSERT_THAT(house_breaches(root_), testing::IsEmpty());
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void plant(const std::string& path, const std::string& text) {
    std::filesystem::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path, std::ios::binary) << text;
  }
  /// The breach that this file is, alone in the house.
  std::string breach(const std::string& path, const std::string& text) {
    plant(path, text);
    const auto all = house_breaches(root_);
    std::filesystem::remove(root_ / path);
    EXPECT_EQ(all.size(), 1u) << path << ": " << text << testing::PrintToString(all);
    return all.empty() ? "" : all[0];
  }
  bool is_fine(const std::string& path, const std::string& text) {
    plant(path, text);
    const auto all = house_breaches(root_);
    std::filesystem::remove(root_ / path);
    return all.empty();
  }

 private:
  std::filesystem::path root_ =
      std::filesystem::temp_directory_path() / ("palpate_house_" + std::to_string(getpid()));
};

}  // namespace palpate::house
