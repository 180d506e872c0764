#include "common/report/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/report/commit.h"

namespace palpate {
namespace {

class JsonFile : public testing::Test {
 protected:
  JsonFile() { std::filesystem::create_directories(folder_); }
  ~JsonFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return folder_ + "/" + name; }

  std::string folder_ =
      (std::filesystem::temp_directory_path() / ("palpate_json_" + std::to_string(getpid()))).string();
};

TEST_F(JsonFile, ComesBackAsItWasWritten) {
  const nlohmann::json value = {{"energy", {{"kinetic", 0.1 + 0.2}, {"elastic", 1e-300}}},
                                {"state_hash", "00ff"}};
  write_json(path("a.json"), value);
  EXPECT_EQ(read_json(path("a.json")), value);
}

TEST_F(JsonFile, LeavesNothingBesideItself) {
  write_json(path("a.json"), {{"first", 1}});
  write_json(path("a.json"), {{"second", 2}});
  EXPECT_EQ(read_json(path("a.json")), (nlohmann::json{{"second", 2}}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(JsonFile, WritesNullForWhatIsNotANumber) {
  write_json(path("a.json"), {{"x", std::nan("")}});
  EXPECT_TRUE(read_json(path("a.json"))["x"].is_null());
}

TEST_F(JsonFile, NamesTheFileThatCannotBeWrittenOrRead) {
  const auto complaint = [](auto call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_THAT(complaint([&] { write_json(path("none/a.json"), {}); }), testing::HasSubstr("none/a.json"));
  EXPECT_THAT(complaint([&] { read_json(path("b.json")); }), testing::HasSubstr("b.json"));
  std::ofstream(path("c.json")) << "{\"half\": ";
  EXPECT_THAT(complaint([&] { read_json(path("c.json")); }), testing::HasSubstr("c.json: is not whole JSON"));
}

TEST(Commit, HasAName) { EXPECT_FALSE(commit().empty()); }

}  // namespace
}  // namespace palpate
