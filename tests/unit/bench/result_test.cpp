// What benchmarks leave behind.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "bench/kernel/kernel_results.h"
#include "bench/machine/machine.h"
#include "bench/machine/result_folder.h"
#include "common/error/error.h"
#include "common/report/json_file.h"

namespace palpate::bench {
namespace {

namespace fs = std::filesystem;

TEST(Results, NameTheMachineThatTheyComeFrom) {
  const auto json = machine();
  for (const char* key : {"commit", "compiler", "flags", "cpu", "cores", "instruction_set", "date"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_FALSE(json["cpu"].get<std::string>().empty());
}

TEST(Results, AreATableAndAJsonFile) {
  const fs::path folder = fs::temp_directory_path() / ("palpate_bench_" + std::to_string(getpid()));
  const ResultFolder results(folder.string(), "thing");
  Table table{{"a_s", "b"}, {}};
  table.add({text_of(0.125), "x"});
  results.write_csv(table);
  results.write_json({{"key", 7}});
  std::stringstream text;
  text << std::ifstream(folder / "thing.csv").rdbuf();
  EXPECT_EQ(text.str(), "a_s,b\n0.125,x\n");
  const auto json = read_json((folder / "thing.json").string());
  EXPECT_EQ(json["results"]["key"], 7);
  EXPECT_TRUE(json["machine"].contains("commit"));
  fs::remove_all(folder);
}

TEST(Results, SayWhichFolderCannotBeMade) {
  try {
    const ResultFolder folder("/proc/nowhere", "thing");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.complaints().at(0).find("/proc/nowhere"), std::string::npos);
  }
}

TEST(KernelRow, CountsByTheMedianAndForRealTimeInWholeSteps) {
  KernelRow row;
  row.ns = {30, 10, 20};
  row.masses = 1000;
  row.stable_step = 1e-3;  // two steps of at most 0.8 ms in a frame of 1 ms
  EXPECT_DOUBLE_EQ(row.median_ns(), 20);
  EXPECT_DOUBLE_EQ(row.least_ns(), 10);
  EXPECT_NEAR(row.real_time_factor(), 1e-3 / (2 * 20e-9 * 1000), 1e-9);
}

}  // namespace
}  // namespace palpate::bench
