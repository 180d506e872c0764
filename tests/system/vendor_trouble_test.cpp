// A vendor's library that gets into trouble while the hand is in contact: three real programs on the stand-in for libHD, from
// `palpate run` to the summary.

#include <gmock/gmock.h>

#include "common/report/json_file.h"
#include "tests/system/dds_domain.h"
#include "tests/system/driver_run.h"

namespace palpate {
namespace {

using testing::HasSubstr;
using testing::Not;

class VendorTrouble : public test::DriverRun {
 protected:
  /// `palpate run` for 6 s, trouble once the hand is in contact. @return exit code
  int run(const std::string& trouble) {
    setenv("STUB_HD_PRESSES", "5", 1);
    setenv("STUB_HD_TROUBLE", trouble.c_str(), 1);
    setenv("STUB_HD_LOG", (folder / "libhd.log").c_str(), 1);
    const int exit_code =
        palpate("run", "live",
                "--nodes physics,haptic --seconds 6 --domain " + std::to_string(test::own_domain()) +
                    " --set device.hand.driver=openhaptics --set " +
                    test::quoted("device.hand.library=" STUB_HD) + " --set 'device.hand.offset_mm=[0,0,22]'");
    for (const char* name : {"STUB_HD_PRESSES", "STUB_HD_TROUBLE", "STUB_HD_LOG"}) unsetenv(name);
    return exit_code;
  }
  /// What the stand-in was told after the trouble, line by line.
  std::string told_after_trouble() const {
    std::ifstream file(folder / "libhd.log");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto at = text.find("trouble ");
    return at == std::string::npos ? "no trouble: " + text : text.substr(at);
  }
  nlohmann::json haptic() const { return read_json((folder / "live" / "summary.json").string())["haptic"]; }
  std::string cause() const {
    return haptic().contains("fault_causes") ? haptic()["fault_causes"][0]["cause"].get<std::string>()
                                             : "none";
  }
};

TEST_F(VendorTrouble, ADeadSchedulerIsNamedMotorsGoOffAndTheSessionEnds) {
  EXPECT_EQ(run("silent"), 1) << said("live");
  EXPECT_THAT(said("live"),
              HasSubstr("fault: the vendor's side stopped calling back (the scheduler of libHD has not "
                        "called back for 100 ms)"));
  EXPECT_THAT(said("live"), HasSubstr("does not come back from closing its device"));
  EXPECT_THAT(said("live"), Not(HasSubstr("was killed")));
  EXPECT_EQ(cause(), "silent");
  EXPECT_THAT(told_after_trouble(), HasSubstr("\nforces off\n"));
}

TEST_F(VendorTrouble, ForcesThatSwitchedThemselvesOffAreNamedAndStayOff) {
  EXPECT_EQ(run("off"), 1) << said("live");
  EXPECT_THAT(said("live"),
              HasSubstr("it switched its forces off by itself (hdIsEnabled: force output is off)"));
  EXPECT_EQ(cause(), "force_off");
  EXPECT_THAT(told_after_trouble(), Not(HasSubstr("forces on")));
}

TEST_F(VendorTrouble, WarmMotorsAreToldBeforeTheVendorsOwnError) {
  EXPECT_EQ(run("warm"), 1) << said("live");
  const std::string said_all = said("live");
  const auto warning = said_all.find("the force goes down to nothing at 95 %");
  const auto none = said_all.find("no force, since its motors are at");
  const auto fault = said_all.find("fault: its motors are too warm (");
  EXPECT_LT(warning, none) << said_all;
  EXPECT_LT(none, fault) << said_all;
  EXPECT_NE(fault, std::string::npos) << said_all;
  EXPECT_EQ(cause(), "overtemp");
}

}  // namespace
}  // namespace palpate
