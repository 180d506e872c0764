// The driver "replay": what it makes of a table, what it says of a bad one, and that a recorded press is felt as the
// spring says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/record/hdf5_file.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A file that goes away with it.
struct PathFile {
  explicit PathFile(const std::string& ending)
      : file(
            (std::filesystem::temp_directory_path() / ("palpate_replay_" + std::to_string(getpid()) + ending))
                .string()) {}
  ~PathFile() { std::filesystem::remove(file); }
  std::string file;
};

struct Table : PathFile {
  explicit Table(const std::string& text, const std::string& ending = ".csv") : PathFile(ending) {
    std::ofstream(file) << text;
  }
};

/// Positions of a path of three poses at 0, 1 and 2 s, as HDF5 has them.
struct Record : PathFile {
  Record() : PathFile(".h5"), hdf5(file, Hdf5File::Mode::create) {}
  void movement(const std::string& group) {
    hdf5.write<double>(group + "t_s", {3}, std::vector<double>{0, 1, 2}.data());
    hdf5.write<double>(group + "p_m", {3, 3}, std::vector<double>{0, 0, 0.01, 0, 0, 0.02, 0, 0, 0.03}.data());
  }
  void run(const std::string& tool) {
    const std::string name = "/tools/" + tool + "/t_p_force_moment";
    hdf5.make_series<double>(name, {10});
    for (int i = 0; i < 3; ++i)
      hdf5.append<double>(name, std::vector<double>{1.0 * i, 0, 0, 0.01 + 0.01 * i, 9, 9, 9, 9, 9, 9}.data());
  }
  Hdf5File hdf5;
};

/// Height of the handle half a second after the path has begun [m].
double height_after_half_a_second(DriverUnderTest& driver) {
  driver.power(true);
  driver.read();
  driver.now += 500'000'000;
  EXPECT_EQ(driver.read(), HDEV_OK);
  return driver.state.pos[2];
}

TEST(ReplayDriver, LeadsTheHandleAlongThePath) {
  const Table table(
      "# a quarter turn about z while going up\n"
      "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,buttons\n"
      "1.0, 10, 0, 20, 1,0,0,0, 0\n"
      "\n"
      "2.0, 10, 0, 40, 0.70710678,0,0,0.70710678, 2\n");
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", table.file}}), HDEV_OK) << driver.api().last_error(nullptr);
  const hdev_info info = driver.info();
  EXPECT_EQ(info.dof_in, 6u);
  EXPECT_NEAR(info.ws_max[2], 0.040, 1e-15);

  // 1. it rests until the forces are on
  driver.now += 5'000'000'000;
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_NEAR(driver.state.pos[2], 0.020, 1e-15);
  EXPECT_EQ(driver.state.force_enabled, 0u);
  // 2. then it moves in the host's clock
  ASSERT_EQ(driver.power(true), HDEV_OK);
  ASSERT_EQ(driver.read(), HDEV_OK);
  driver.now += 500'000'000;
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_NEAR(driver.state.pos[0], 0.010, 1e-15);
  EXPECT_NEAR(driver.state.pos[2], 0.030, 1e-12);
  EXPECT_NEAR(driver.state.R[0], std::cos(M_PI / 8 * 2), 1e-7);  // 45 degrees: row after row
  EXPECT_NEAR(driver.state.R[1], -std::sin(M_PI / 4), 1e-7);
  EXPECT_NEAR(driver.state.R[3], std::sin(M_PI / 4), 1e-7);
  EXPECT_EQ(driver.state.buttons, 0u);
  // 3. and rests at the end
  driver.now += 5'000'000'000;
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_NEAR(driver.state.pos[2], 0.040, 1e-15);
  EXPECT_EQ(driver.state.buttons, 2u);
}

TEST(ReplayDriver, ReadsFieldsBetweenBlanks) {
  const Table table("t_s  x_mm y_mm\tz_mm  fx_N\r\n 0 1 2 3 9\n  1.5   4\t5  6 9  \n");
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", table.file}}), HDEV_OK) << driver.api().last_error(nullptr);
  driver.power(true);
  driver.read();
  EXPECT_NEAR(driver.state.pos[2], 0.003, 1e-15);
  driver.now += 1'500'000'000;
  driver.read();
  EXPECT_NEAR(driver.state.pos[0], 0.004, 1e-15);
}

TEST(ReplayDriver, PlaysTheFlightOfAFault) {
  const Table table(
      "t_s,state,x_m,y_m,z_m,qw,qx,qy,qz,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,"
      "energy_J,surplus_J,"
      "patch_age_s\n"
      "7.001,run,0.01,0.02,0.03,0.5,-0.5,0.5,0.5,0,0,0,1,2,3,0.1,0.2,0.3,0,0,-1\n"
      "7.002,fault,0.02,0.02,0.03,0.5,-0.5,0.5,0.5,0,0,0,0,0,0,0,0,0,0,0,0\n");
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", table.file}}), HDEV_OK) << driver.api().last_error(nullptr);
  driver.power(true);
  driver.read();
  EXPECT_NEAR(driver.state.pos[0], 0.01, 1e-15);
  EXPECT_NEAR(driver.state.R[3], 0, 1e-12);  // z becomes y, x becomes z
  EXPECT_NEAR(driver.state.R[5], 1, 1e-12);
  driver.now += 1'000'000;
  driver.read();
  EXPECT_NEAR(driver.state.pos[0], 0.02, 1e-15);
}

TEST(ReplayDriver, TakesTheNamesOfColumnsFromTheScene) {
  const Table table("# t x y z and what else there may be\n0 1 2 3 9 9\n1000 1 2 5 9 9\n");
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", table.file}, {"columns", "t_ms x_mm y_mm z_mm"}}), HDEV_OK)
      << driver.api().last_error(nullptr);
  EXPECT_NEAR(height_after_half_a_second(driver), 0.004, 1e-12);
  EXPECT_THAT(driver.trouble({{"file", table.file}, {"columns", "t_s x_mm"}}), HasSubstr("no column y_mm"));
  EXPECT_THAT(driver.trouble({{"file", table.file}, {"columns", "t_s a b c d e f x_m y_m z_m"}}),
              HasSubstr(":2:11: 6 fields, wanted are 10"));
  EXPECT_THAT(driver.trouble({{"file", table.file}, {"group", "/x"}}), HasSubstr("a table has no \"group\""));
}

TEST(ReplayDriver, PlaysMovementsFromHdf5) {
  Record record;
  record.movement("/");
  record.hdf5.write<double>("/q_wxyz", {3, 4},
                            std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}.data());
  record.hdf5.write<std::int32_t>("/buttons", {3}, std::vector<std::int32_t>{2, 0, 0}.data());
  record.movement("/other/");
  record.hdf5.close();
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", record.file}}), HDEV_OK) << driver.api().last_error(nullptr);
  EXPECT_EQ(driver.info().dof_in, 6u);
  EXPECT_NEAR(height_after_half_a_second(driver), 0.015, 1e-12);
  EXPECT_EQ(driver.state.buttons, 2u);
  driver.now += 5'000'000'000;
  driver.read();
  EXPECT_NEAR(driver.state.R[4], -1, 1e-12) << "turned by half about x";
  driver.close();
  ASSERT_EQ(driver.open({{"file", record.file}, {"group", "/other"}}), HDEV_OK);
  EXPECT_EQ(driver.info().dof_in, 3u);
}

TEST(ReplayDriver, PlaysTheRecordOfARun) {
  DriverUnderTest driver("replay");
  {
    Record record;
    record.run("tip");
    record.hdf5.close();
    ASSERT_EQ(driver.open({{"file", record.file}}), HDEV_OK) << driver.api().last_error(nullptr);
    EXPECT_NEAR(height_after_half_a_second(driver), 0.015, 1e-12);
    driver.close();
  }
  Record record;
  record.run("tip");
  record.run("knife");
  record.hdf5.close();
  EXPECT_THAT(driver.trouble({{"file", record.file}}),
              HasSubstr("several movements; choose with group = /tools/knife or /tools/tip"));
  ASSERT_EQ(driver.open({{"file", record.file}, {"group", "/tools/tip"}}), HDEV_OK);
}

TEST(ReplayDriver, SaysWhatIsWrongWithAnHdf5File) {
  DriverUnderTest driver("replay");
  const auto said = [&](auto&& fill) {
    Record record;
    fill(record.hdf5);
    record.hdf5.close();
    const std::string words = driver.trouble({{"file", record.file}});
    EXPECT_THAT(words, StartsWith(record.file + ": "));
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
    return words;
  };
  const std::vector<double> n{0, 1, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT(said([](Hdf5File& f) { f.make_group("/x"); }),
              HasSubstr("no movement in it; wanted is a group with t_s"));
  EXPECT_THAT(said([&](Hdf5File& f) { f.write("/t_s", {2}, n.data()); }), HasSubstr("no dataset /p_m"));
  EXPECT_THAT(said([&](Hdf5File& f) {
                f.write("/t_s", {2}, n.data()), f.write("/p_m", {3, 3}, n.data());
              }),
              HasSubstr("/p_m is 3 x 3 numbers; 2 x 3 are wanted"));
  EXPECT_THAT(said([&](Hdf5File& f) {
                f.write("/t_s", {2, 1}, n.data()), f.write("/p_m", {2, 3}, n.data());
              }),
              HasSubstr("/t_s is 2 x 1 numbers; n x 1 are wanted"));
  EXPECT_THAT(said([&](Hdf5File& f) {
                f.write("/t_s", {3}, n.data()), f.write("/p_m", {3, 3}, n.data());
              }),
              HasSubstr("row 2 of /: 1 s follows 1 s; times must grow"));
  const Table cut("\x89HDF\r\n\x1a\nand nothing more", ".h5");
  EXPECT_THAT(driver.trouble({{"file", cut.file}}), HasSubstr("is not an HDF5 file, or was cut short"));
  Record record;
  record.movement("/");
  record.hdf5.close();
  EXPECT_THAT(driver.trouble({{"file", record.file}, {"columns", "t_s x_m y_m z_m"}}),
              HasSubstr("HDF5 has no \"columns\""));
  EXPECT_THAT(driver.trouble({{"file", record.file}, {"group", "/nowhere"}}),
              HasSubstr("no dataset /nowhere/t_s"));
}

TEST(ReplayDriver, LoopsAPathThatEndsWhereItBegins) {
  const Table table("t_s,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0.01\n2,0,0,0\n");
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open({{"file", table.file}, {"loop", "true"}}), HDEV_OK);
  driver.power(true);
  driver.read();
  driver.now += 3'000'000'000;
  driver.read();
  EXPECT_NEAR(driver.state.pos[2], 0.01, 1e-12);
}

TEST(ReplayDriver, SaysWhereATableIsWrong) {
  const auto said = [](const std::string& text, const std::string& loop = "false") {
    const Table table(text);
    std::string words = DriverUnderTest("replay").trouble({{"file", table.file}, {"loop", loop}});
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
    EXPECT_THAT(words, StartsWith(table.file));
    return words.substr(std::min(table.file.size(), words.size()));
  };
  EXPECT_THAT(said(""), HasSubstr(":1:1: nothing in it"));
  EXPECT_THAT(said("x_mm,y_mm,z_mm\n"), HasSubstr(":1:1: no column t_s"));
  EXPECT_THAT(said("t_s,x_mm,y_mm\n"), HasSubstr(":1:1: no column z_mm"));
  EXPECT_THAT(said("t_s,t_s,x_m,y_m,z_m\n"), HasSubstr(":1:5: a second column t_s"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m,qw\n"), HasSubstr(":1:1: an attitude needs all"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n"), HasSubstr("no pose"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n0,0,0\n"), HasSubstr(":2:5: 3 fields, the first line names 4"));
  EXPECT_THAT(said("#\nt_s,x_m,y_m,z_m\n0,0, wide,0\n"), HasSubstr(":3:6: \"wide\" is no number"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n0,,0,0\n"), HasSubstr(":2:3: \"\" is no number"));
  EXPECT_THAT(said("t_s x_m y_m z_m\n0 0  wide 0\n"), HasSubstr(":2:6: \"wide\" is no number"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n0,0,nan,0\n"), HasSubstr(":2:5: \"nan\" is no number"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n1,0,0,0\n1,0,0,0\n"), HasSubstr(":3:1: 1 s follows 1 s"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,0,2,0,0,0\n"),
              HasSubstr(":2:9: the attitude has length 2"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m,buttons\n1,0,0,0,0.5\n"), HasSubstr(":2:9: buttons is a sum"));
  EXPECT_THAT(said("t_s,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0.01\n", "true"),
              HasSubstr("ends 10 mm from where it begins"));
}

TEST(ReplayDriver, SaysWhatItWantsToBeTold) {
  DriverUnderTest driver("replay");
  EXPECT_THAT(driver.trouble({}), HasSubstr("no \"file\""));
  EXPECT_THAT(driver.trouble({{"file", "no/such/table.csv"}}), HasSubstr("no/such/table.csv: No such file"));
  EXPECT_THAT(driver.trouble({{"fill", "x"}}),
              HasSubstr("unknown key \"fill\"; known are file, columns, group, loop, max_force_N"));
  EXPECT_THAT(driver.trouble({{"loop", "yes"}}), HasSubstr("true or false"));
  EXPECT_THAT(driver.trouble({}, "left"), HasSubstr("no device \"left\""));
}

/// A plane of 0.5 N/mm, pressed 4 mm deep along a recorded path, as in the data of Ruffaldi et al. 2006. Analytic:
///   f = K max(0, -z),  without a damper.
TEST(ReplayDriver, FeelsTheAnalyticForceOfAPlane) {
  std::string text = "t_s,x_m,y_m,z_m\n";
  constexpr double period = 2.0, depth = 0.004;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.01 * i;
    text += std::to_string(t) + ",0,0," + std::to_string(depth * std::cos(2 * M_PI * t / period)) + "\n";
  }
  const Table table(text);
  Scene scene = scene_with(HandModel::rigid, {}, 500);
  scene.tools[0].damping = 0;
  scene.devices[0].driver = "replay";
  scene.devices[0].options = {{"file", table.file}};
  VirtualWorld world(scene);
  double error = 0, size = 0;
  int touched = 0;
  world.run(4.0, 1000, [&] {
    const double f = 500 * std::max(0.0, -world.z());
    error += (world.fz() - f) * (world.fz() - f);
    size += f * f;
    touched += f > 0 ? 1 : 0;
  });
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_GT(touched, 1900);
  EXPECT_LE(std::sqrt(error / size), 0.01) << "of the force's own RMS " << std::sqrt(size / touched) << " N";
  RecordProperty("force_rms_error_percent", std::to_string(100 * std::sqrt(error / size)));
}

/// P4: a scan across a plane in a .traj, positions and forces in lines of numbers without names, pressed up to 4 mm
/// deep at 0.5 N/mm. The force that is felt is compared with the forces in the file, tick by tick. What is off is at the end of
/// the way out, where the energy limit keeps back what a force that comes a tick late has not taken in.
TEST(ReplayDriver, FeelsThePlaneOfATrajectoryFile) {
  constexpr double K = 0.5, seconds = 4.0;  // [N/mm], [s]
  const auto z_mm = [](double t) { return 4 * std::cos(M_PI * t); };
  const auto newton = [&](double t) { return K * std::max(0.0, -z_mm(t)); };
  std::string text;
  for (int i = 0; i <= 400; ++i) {
    const double t = i * seconds / 400;
    text += std::to_string(t) + " " + std::to_string(-20 + 10 * t) + " 0 " + std::to_string(z_mm(t)) +
            " 0 0 " + std::to_string(newton(t)) + "\n";
  }
  const Table table(text, ".traj");
  Scene scene = scene_with(HandModel::rigid, {}, 500);
  scene.tools[0].damping = 0;
  scene.devices[0].driver = "replay";
  scene.devices[0].options = {{"file", table.file}};
  VirtualWorld world(scene);
  double error = 0, size = 0, error_pressed = 0;
  world.run(4.0, 1000, [&] {
    if (world.session.first_run_ns() == 0) return;
    const double t = 1e-9 * static_cast<double>(world.now - world.session.first_run_ns());
    const double squared = std::pow(world.fz() - newton(t), 2);
    error += squared;
    if (newton(t) > 0.4) error_pressed += squared;
    size += std::pow(newton(t), 2);
  });
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_GT(size, 1000.0);
  EXPECT_LE(std::sqrt(error / size), 0.01);
  EXPECT_LE(std::sqrt(error_pressed / size), 2e-4) << "above 0.4 N";
  RecordProperty("force_rms_error_percent", std::to_string(100 * std::sqrt(error / size)));
  std::printf("force RMS error %.3f %% of the analytic force, %.4f %% above 0.4 N\n",
              100 * std::sqrt(error / size), 100 * std::sqrt(error_pressed / size));
}

}  // namespace
}  // namespace palpate::haptic::test
