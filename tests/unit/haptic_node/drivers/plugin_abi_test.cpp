// What the contract asks of every driver, whatever the device: other versions of the host, structs of other sizes, and
// being opened and closed again and again.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/unit/haptic_node/drivers/opened_driver.h"

namespace palpate::haptic::test {
namespace {

std::vector<std::string> drivers_built() { return drivers_present({PALPATE_TEST_DRIVERS}); }

/// Drivers that need nothing but a file.
struct Case {
  std::string name;
  std::map<std::string, std::string> options;
};
std::vector<Case> cases() {
  const auto file =
      std::filesystem::temp_directory_path() / ("palpate_abi_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,1,2,3,1,0,0,0\n";
  return {{"simulated", {}}, {"replay", {{"file", file.string()}}}};
}

TEST(PluginAbi, ServesNoHostOfAnotherMajorVersion) {
  ASSERT_GE(drivers_built().size(), 5u);
  for (const auto& name : drivers_built()) {
    const std::string file = std::string(PALPATE_TEST_DRIVERS) + "/palpate_driver_" + name + ".so";
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(handle, nullptr) << dlerror();
    const auto query = reinterpret_cast<hdev_plugin_query_fn>(dlsym(handle, HDEV_ENTRY_SYMBOL));
    ASSERT_NE(query, nullptr) << name;
    EXPECT_EQ(query(HDEV_ABI_MAJOR + 1, 0), nullptr) << name;
    const hdev_api* api = query(HDEV_ABI_MAJOR, HDEV_ABI_MINOR + 1);
    ASSERT_NE(api, nullptr) << name;
    EXPECT_EQ(api->abi_major, HDEV_ABI_MAJOR) << name;
    EXPECT_EQ(api->size, sizeof(hdev_api)) << name;
    EXPECT_EQ(name, api->plugin_name);
  }
}

TEST(PluginAbi, WritesNoMoreThanTheHostKnows) {
  for (const auto& [name, options] : cases()) {
    DriverUnderTest driver(name);
    ASSERT_EQ(driver.open(options), HDEV_OK) << name;
    // 1. an older host: the structs end early, and what follows is somebody else's
    constexpr std::uint32_t short_info = offsetof(hdev_info, max_torque),
                            short_state = offsetof(hdev_state, vel);
    hdev_info info;
    hdev_state state;
    std::memset(&info, 0x5a, sizeof info);
    std::memset(&state, 0x5a, sizeof state);
    info.size = short_info;
    state.size = short_state;
    ASSERT_EQ(driver.api().get_info(driver.device(), &info), HDEV_OK) << name;
    ASSERT_EQ(driver.api().read(driver.device(), &state, 0), HDEV_OK) << name;
    EXPECT_EQ(info.size, short_info) << name;
    EXPECT_GT(info.max_force, 0) << name;
    EXPECT_EQ(state.size, short_state) << name;
    EXPECT_EQ(state.R[8], 1) << name;
    const auto untouched = [&](const void* start, std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i)
        if (static_cast<const unsigned char*>(start)[i] != 0x5a) return false;
      return true;
    };
    EXPECT_TRUE(untouched(&info, short_info, sizeof info)) << name;
    EXPECT_TRUE(untouched(&state, short_state, sizeof state)) << name;

    // 2. a newer host: the structs are longer than the driver knows
    struct {
      hdev_state known;
      double more = 7;
    } longer{};
    longer.known.size = sizeof longer;
    ASSERT_EQ(driver.api().read(driver.device(), &longer.known, 0), HDEV_OK) << name;
    EXPECT_EQ(longer.more, 7) << name;
  }
}

TEST(PluginAbi, TakesAShortCommandForOneWithoutTheRest) {
  DriverUnderTest driver("replay");
  ASSERT_EQ(driver.open(cases()[1].options), HDEV_OK);
  driver.power(true);
  hdev_command command{};
  command.size = offsetof(hdev_command, torque);
  command.force[0] = 2;
  command.torque[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(driver.api().write(driver.device(), &command), HDEV_OK) << "the torque is not part of it";
  driver.read();
  EXPECT_EQ(driver.state.applied_force[0], 2);
}

TEST(PluginAbi, OpensAndClosesAThousandTimes) {
  for (const auto& [name, options] : cases()) {
    DriverUnderTest driver(name);
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(driver.open(options), HDEV_OK) << name;
      driver.close();
    }
    driver.api().close(nullptr);
  }
}

TEST(PluginAbi, TellsMoreDevicesThanThereIsRoomFor) {
  DriverUnderTest driver("simulated");
  char none[1][64] = {""};
  std::uint32_t n = 0;
  EXPECT_EQ(driver.api().enumerate(&driver.host(), none, 0, &n), HDEV_OK);
  EXPECT_EQ(n, 1u);
  EXPECT_STREQ(none[0], "");
  EXPECT_EQ(DriverUnderTest("replay").api().enumerate(&driver.host(), none, 0, &n), HDEV_OK);
  EXPECT_EQ(n, 1u);
}

}  // namespace
}  // namespace palpate::haptic::test
