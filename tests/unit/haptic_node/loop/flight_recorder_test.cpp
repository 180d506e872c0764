#include "haptic_node/loop/flight_recorder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/error/error.h"

namespace palpate::haptic::test {
namespace {

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

FlightSample sample_at(int tick) {
  FlightSample sample;
  sample.trace.tick = static_cast<std::uint64_t>(tick);
  sample.trace.t = 1e-3 * tick;
  sample.trace.force = {0, 0, 0.1 * tick};
  sample.state = tick < 29'900 ? HapticState::run : HapticState::fault;
  return sample;
}

class FlightTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path); }
  std::string path =
      (std::filesystem::temp_directory_path() / ("palpate_flight_" + std::to_string(getpid()) + ".csv"))
          .string();
  FlightRecorder recorder{1000};
};

TEST_F(FlightTest, KeepsTenSecondsUntilAFifthOfASecondAfterTheTrigger) {
  for (int tick = 0; tick < 29'900; ++tick) recorder.add(sample_at(tick));
  EXPECT_FALSE(recorder.write_kept(path));
  recorder.trigger();
  for (int tick = 29'900; tick < 31'000; ++tick) recorder.add(sample_at(tick));
  ASSERT_TRUE(recorder.write_kept(path));
  const auto lines = lines_of(path);
  ASSERT_EQ(lines.size(), 10'001u);
  EXPECT_EQ(lines[1].substr(0, 14), "20.100000,run,");
  EXPECT_EQ(lines.back().substr(0, 16), "30.099000,fault,");
  EXPECT_FALSE(recorder.write_kept(path)) << "once";
}

TEST_F(FlightTest, WritesPoseForceAndTorque) {
  FlightSample sample = sample_at(3);
  sample.trace.p = {0.1, 0.2, 0.3};
  sample.q_WT = {0.5, -0.5, 0.5, 0.5};
  sample.trace.proxy = {0.4, 0.5, 0.6};
  sample.trace.force = {1, 2, 3};
  sample.trace.torque = {0.01, 0.02, 0.03};
  sample.trace.energy = 4e-3;
  sample.surplus = 5e-3;
  sample.patch_age = 0.006;
  recorder.trigger();
  recorder.add(sample);
  recorder.end();
  ASSERT_TRUE(recorder.write_kept(path));
  const auto lines = lines_of(path);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(
      lines[0],
      "t_s,state,x_m,y_m,z_m,qw,qx,qy,qz,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,"
      "energy_J,surplus_J,patch_age_s");
  EXPECT_EQ(
      lines[1],
      "0.003000,run,0.1,0.2,0.3,0.5,-0.5,0.5,0.5,0.4,0.5,0.6,1,2,3,0.01,0.02,0.03,0.004,0.005,0.006000");
}

TEST_F(FlightTest, KeepsTheFirstWhenASecondComesBeforeItIsWritten) {
  for (int event = 0; event < 2; ++event) {
    recorder.trigger();
    for (int tick = 0; tick < 200; ++tick) recorder.add(sample_at(tick + 1000 * event));
  }
  EXPECT_EQ(recorder.dropped(), 1u);
  ASSERT_TRUE(recorder.write_kept(path));
  const auto lines = lines_of(path);
  ASSERT_EQ(lines.size(), 201u);
  EXPECT_EQ(lines[1].substr(0, 9), "0.000000,");
  recorder.trigger();
  recorder.add(sample_at(7));
  recorder.end();
  ASSERT_TRUE(recorder.write_kept(path)) << "the end does not wait";
}

TEST_F(FlightTest, SaysWhereItCannotWrite) {
  recorder.trigger();
  recorder.add(sample_at(1));
  recorder.end();
  EXPECT_THROW(recorder.write_kept("/nowhere/at/all.csv"), InputError);
  EXPECT_FALSE(recorder.has_kept()) << "it is not tried for ever";
}

}  // namespace
}  // namespace palpate::haptic::test
