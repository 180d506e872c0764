// One scene, other drivers: a key of the scene changes, and not a line of the program.

#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "common/report/json_file.h"
#include "common/wire/writer.h"
#include "tests/system/dds_domain.h"
#include "tests/system/driver_run.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DriverSwap : public test::DriverRun {};

TEST_F(DriverSwap, PlaysTheTraceOfARunAndFeelsTheSame) {
  ASSERT_EQ(palpate("simulate", "hand", "--no-frames --seconds 2"), 0) << said("hand");
  const std::string file = (folder / "hand" / "tool_tip.csv").string();
  ASSERT_EQ(palpate("simulate", "played",
                    "--no-frames --seconds 2 --set device.hand.driver=replay --set device.hand.file=" + file),
            0)
      << said("played");
  const std::string record = (folder / "hand" / "record.h5").string();
  ASSERT_EQ(
      palpate("simulate", "record",
              "--no-frames --seconds 2 --set device.hand.driver=replay --set device.hand.file=" + record),
      0)
      << said("record");
  EXPECT_NEAR(peak("record"), peak("hand"), 0.01 * peak("hand"));
  EXPECT_GT(peak("hand"), 0.1);
  EXPECT_NEAR(peak("played"), peak("hand"), 0.01 * peak("hand"));
}

TEST_F(DriverSwap, PressesThroughThreeProcessesWithAVendorsLibrary) {
  setenv("STUB_HD_PRESSES", "5", 1);  // 5 mm, of which 3 are in the tissue
  const int exit_code =
      palpate("run", "live",
              "--headless --seconds 3 --domain " + std::to_string(test::own_domain()) +
                  " --set device.hand.driver=openhaptics --set " +
                  test::quoted("device.hand.library=" STUB_HD) + " --set 'device.hand.offset_mm=[0,0,22]'");
  unsetenv("STUB_HD_PRESSES");
  ASSERT_EQ(exit_code, 0) << said("live");
  const auto summary = read_json((folder / "live" / "summary.json").string());
  EXPECT_EQ(summary["haptic"]["faults"].get<int>(), 0);
  double lowest = 1;
  for (const auto& [z, force] : trace("live"))
    if (force > 0) lowest = std::min(lowest, z);
  EXPECT_NEAR(lowest, 0.017, 1e-3);
  EXPECT_GT(peak("live"), 0.1);
}

TEST_F(DriverSwap, PressesThroughThreeProcessesWithTheMouse) {
  // This test stands in for the window: the pointer goes down to 3 mm below the surface and stays.
  std::atomic<bool> over{false};
  std::thread hand([&] {
    // A session wants the ports of its domain for itself until it has begun.
    while (!over && !fs::exists(folder / "pointed"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    Participant participant(test::own_domain());
    Writer<Pointer> writer(participant);
    const auto begin = std::chrono::steady_clock::now();
    std::optional<double> found;  // when the driver was first there [s]
    for (Pointer pointer; !over; std::this_thread::sleep_for(std::chrono::milliseconds(16))) {
      const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      if (!found && writer.matched() > 0) found = t;
      const double down = found ? std::clamp((t - *found - 1.5) / 1.0, 0.0, 1.0) : 0.0;
      pointer.tick += 1;
      pointer.p_W = {0, 0, 0.026 - 0.009 * down};
      pointer.held = 1;
      writer.write(pointer);
    }
  });
  const int exit_code =
      palpate("run", "pointed",
              "--headless --seconds 4 --device mouse --domain " + std::to_string(test::own_domain()));
  over = true;
  hand.join();
  ASSERT_EQ(exit_code, 0) << said("pointed");
  const auto summary = read_json((folder / "pointed" / "summary.json").string());
  EXPECT_EQ(summary["haptic"]["faults"].get<int>(), 0);
  double lowest = 1;
  for (const auto& [z, force] : trace("pointed"))
    if (force > 0) lowest = std::min(lowest, z);
  EXPECT_NEAR(lowest, 0.017, 1e-3);
  EXPECT_GT(peak("pointed"), 0.1);
}

TEST_F(DriverSwap, LeavesTheKeysOfTheScenesOwnDriverOut) {
  // The scene is made to name a model of the simulated hand, which no other driver knows.
  const fs::path scene = folder / "own.toml";
  std::ifstream from(SCENES "/box_press.toml");
  std::ofstream to(scene);
  for (std::string line; std::getline(from, line);)
    to << line << (line == "driver    = \"simulated\"" ? "\nmodel = \"touch\"\n" : "\n");
  to.close();
  std::ofstream(folder / "path.csv") << "t_s,x_mm,y_mm,z_mm\n0,0,0,30\n9,0,0,30\n";
  const std::string command = test::quoted(PALPATE) + " simulate " + test::quoted(scene) +
                              " --no-frames --seconds 0.05 --out " + test::quoted(folder / "own") +
                              " --set device.hand.driver=replay --set " +
                              test::quoted("device.hand.file=" + (folder / "path.csv").string()) + " >" +
                              test::quoted(folder / "own.log") + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << said("own");
}

TEST_F(DriverSwap, HasNoMouseInSimulatedTime) {
  EXPECT_EQ(palpate("simulate", "none", "--device mouse"), 2);
  EXPECT_THAT(said("none"), HasSubstr("driver \"mouse\": there is no window to point in"));
}

TEST_F(DriverSwap, SaysWhatADriverLacksBeforeAnythingIsFelt) {
  EXPECT_EQ(palpate("simulate", "none",
                    "--set device.hand.driver=openhaptics --set device.hand.library=/no/libHD.so"),
            2);
  EXPECT_THAT(said("none"),
              HasSubstr("box_press.toml:30:1: driver \"openhaptics\": the library of OpenHaptics does not "
                        "load (/no/libHD.so: cannot open shared object file"));
  EXPECT_EQ(palpate("simulate", "none", "--device replay"), 2);
  EXPECT_THAT(said("none"), HasSubstr("driver \"replay\": no \"file\"; name a table of poses"));
  EXPECT_FALSE(fs::exists(folder / "none")) << "a driver that refuses leaves no folder";
  EXPECT_EQ(palpate("run", "none", "--device omega"), 2);
  EXPECT_THAT(said("none"), HasSubstr("no driver \"omega\"; drivers here: forcedimension, inverse3"));
}

}  // namespace
}  // namespace palpate
