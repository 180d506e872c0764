#include "deploy/palpate/plotter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

const char* const heading = "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,contacts\n";

bool is_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(8, '\0');
  return file.read(start.data(), 8) && start == "\x89PNG\r\n\x1a\n";
}

std::string complaint_about(const std::filesystem::path& folder) {
  testing::internal::CaptureStderr();
  const bool drawn = draw_plots(folder);
  const std::string text = testing::internal::GetCapturedStderr();
  return drawn ? "drawn" : text;
}

TEST(Plotter, DrawsForceAndEnergy) {
  const test::TemporaryFolder folder;
  std::string rows = heading;
  for (int i = 0; i < 50; ++i)
    rows += std::to_string(i * 0.1) + ",0,0,0.01,0,0," + std::to_string(std::sin(i)) + ",0,0.1,0,3\n";
  folder.write("finger.csv", rows + "5.0,0.01");  // cut short in the last line
  folder.write("energy.csv", "t_s,kinetic_J,elastic_J\n0,0,0\n1,0.5,0.2\n");
  folder.write("summary.json", R"({"tools": {"finger": {"trace": "finger.csv"}}})");
  EXPECT_TRUE(draw_plots(folder.path()));
  EXPECT_TRUE(is_png(folder / "force.png"));
  EXPECT_TRUE(is_png(folder / "energy.png"));
}

TEST(Plotter, DrawsRawCurvesWhereTheTraceHasThem) {
  const auto drawn = [](const std::string& more_headings, const std::string& more) {
    const test::TemporaryFolder folder;
    std::string rows = std::string(heading).substr(0, std::string(heading).size() - 1) + more_headings + "\n";
    for (int i = 0; i < 50; ++i)
      rows +=
          std::to_string(i * 0.1) + ",0,0,0.01,0,0," + std::to_string(0.1 * i) + ",0,0.1,0,3" + more + "\n";
    folder.write("knife.csv", rows);
    folder.write("summary.json", R"({"tools": {"knife": {"trace": "knife.csv"}}})");
    EXPECT_TRUE(draw_plots(folder.path()));
    std::ifstream file(folder / "force.png", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string plain = drawn("", "");
  const std::string raw =
      drawn(",raw_fx_N,raw_fy_N,raw_fz_N,raw_mx_Nm,raw_my_Nm,raw_mz_Nm", ",0,0,4,0,0.2,0");
  EXPECT_EQ(plain, drawn("", ""));
  EXPECT_NE(plain, raw);
}

TEST(Plotter, DrawsNothingWhereThereIsNothing) {
  const test::TemporaryFolder folder;
  folder.write("summary.json", "{}");
  EXPECT_TRUE(draw_plots(folder.path()));
  EXPECT_FALSE(std::filesystem::exists(folder / "force.png"));
}

TEST(Plotter, NamesWhatItCannotRead) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(complaint_about(folder.path()), testing::HasSubstr("summary.json"));
  folder.write("summary.json", R"({"tools": {"finger": {"trace": "finger.csv"}}})");
  EXPECT_THAT(complaint_about(folder.path()), testing::HasSubstr("finger.csv"));
  folder.write("finger.csv", "t_s,x_m\n0,0\n");
  EXPECT_THAT(complaint_about(folder.path()), testing::HasSubstr("finger.csv: lacks the column y_m"));
}

}  // namespace
}  // namespace palpate::deploy
