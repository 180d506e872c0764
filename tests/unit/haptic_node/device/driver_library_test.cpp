#include "haptic_node/device/driver_library.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "haptic_node/device/device.h"

namespace palpate::haptic {
namespace {

/// What load() says, or "" if it loads.
std::string complaint(const std::string& name, const std::string& place = {}) {
  setenv("PALPATE_DRIVERS", PALPATE_TEST_DRIVERS ":" PALPATE_BROKEN_DRIVERS, 1);
  try {
    DriverLibrary::load(name, place);
    return {};
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints().size(), 1u);
    return error.what();
  }
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DriverLibrary, LoadsTheSimulatedHand) { EXPECT_EQ(complaint("simulated"), ""); }

TEST(DriverLibrary, SaysWhereItLookedAndWhatIsThere) {
  const std::string line = complaint("omega", "scenes/a.toml:7:1");
  EXPECT_TRUE(line.starts_with("scenes/a.toml:7:1: driver \"omega\": palpate_driver_omega.so not found"))
      << line;
  EXPECT_TRUE(has(line, PALPATE_TEST_DRIVERS)) << line;
  EXPECT_TRUE(has(line, "lib/palpate/drivers")) << line;
  EXPECT_TRUE(has(line, "simulated")) << line;
}

TEST(DriverLibrary, QuotesTheLoaderOnAFileThatIsNoLibrary) {
  const auto file = std::filesystem::path(PALPATE_BROKEN_DRIVERS) / "palpate_driver_text.so";
  std::ofstream(file) << "not a library at all";
  const std::string line = complaint("text");
  EXPECT_TRUE(has(line, "palpate_driver_text.so")) << line;
  EXPECT_TRUE(has(line, "file too short") || has(line, "invalid ELF header")) << line;
}

TEST(DriverLibrary, NamesTheSymbolThatADriverLacks) {
  const std::string line = complaint("nosymbol");
  EXPECT_TRUE(has(line, "palpate_driver_nosymbol.so lacks hdev_plugin_query()")) << line;
  EXPECT_TRUE(has(line, "undefined symbol")) << line;
}

TEST(DriverLibrary, NamesTheVendorFunctionThatIsMissing) {
  const std::string line = complaint("nosdk");
  EXPECT_TRUE(has(line, "palpate_driver_nosdk.so")) << line;
  EXPECT_TRUE(has(line, "vendor_function_that_nobody_has")) << line;
}

TEST(DriverLibrary, RefusesAnotherMajorVersion) {
  const std::string line = complaint("abi2");
  EXPECT_TRUE(has(line, "palpate_driver_abi2.so speaks ABI 2.2, this palpate speaks 1.2")) << line;
}

TEST(DriverLibrary, RefusesATableThatIsTooShortOrHasHoles) {
  EXPECT_TRUE(has(complaint("short"), "hands out a table of 16 bytes"));
  EXPECT_TRUE(has(complaint("hole"), "leaves stop() null"));
  EXPECT_TRUE(has(complaint("null"), "does not serve ABI 1.2"));
}

TEST(DriverLibrary, TakesATableOfTheFirstVersionForOneWithoutTheRest) {
  setenv("PALPATE_DRIVERS", PALPATE_BROKEN_DRIVERS, 1);
  const DriverLibrary library = DriverLibrary::load("first");
  EXPECT_NE(library.api().stop, nullptr);
  EXPECT_EQ(library.api().emergency_stop, nullptr) << "what lies behind the end of the driver's table";
  EXPECT_EQ(library.api().rescue, nullptr);
}

TEST(DriverLibrary, RefusesNamesThatLeaveTheFolder) {
  for (const char* name : {"", "../simulated", "a/b", "Simulated", "x.so"})
    EXPECT_TRUE(has(complaint(name), "not a driver's name")) << name;
}

TEST(Device, OpensClosesAndOpensAgain) {
  setenv("PALPATE_DRIVERS", PALPATE_TEST_DRIVERS, 1);
  const DriverLibrary library = DriverLibrary::load("simulated");
  std::int64_t now = 0;
  const auto clock = [](void* user) { return *static_cast<std::int64_t*>(user); };
  for (int i = 0; i < 1000; ++i) {
    Device device(library, {{"hand", "pinch"}}, clock, &now, "");
    EXPECT_TRUE(device.is_open());
    device.close();
    device.close();
  }
}

TEST(Device, PassesOnWhatADriverSaysOfItsOptions) {
  setenv("PALPATE_DRIVERS", PALPATE_TEST_DRIVERS, 1);
  const DriverLibrary library = DriverLibrary::load("simulated");
  std::int64_t now = 0;
  const auto clock = [](void* user) { return *static_cast<std::int64_t*>(user); };
  const auto said = [&](const Device::Options& options) -> std::string {
    try {
      Device device(library, options, clock, &now, "a.toml:1:1");
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said({}), "");
  EXPECT_TRUE(has(said({{"hand", "foot"}}), "rigid, arm, pinch or firm"));
  EXPECT_TRUE(has(said({{"mass", "-1"}}), "above 0"));
  EXPECT_TRUE(has(said({{"waypoints", "0 0 0"}}), "four numbers"));
  EXPECT_TRUE(has(said({{"waypoints", "1 0 0 0; 1 0 0 0"}}), "after the one before"));
  EXPECT_TRUE(has(said({{"waypoints", "0 0 0 0; 1 0 0 3"}}), "outside its workspace"));
  EXPECT_TRUE(has(said({{"id", "other"}}), "no device \"other\""));
  EXPECT_TRUE(has(said({{"seed", "x"}}), "whole number"));
}

}  // namespace
}  // namespace palpate::haptic
