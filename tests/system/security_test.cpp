// DDS Security with the certificates of deploy/security: who has them talks, who has none neither hears nor is heard.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/dds_domain.h"
#include "tests/system/memory_room.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Security : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    test::Process make({MAKE_CERTIFICATES, (folder / "keys").string()}, (folder / "made").string());
    ASSERT_EQ(make.wait(), 0) << make.text();
  }
  ~Security() override {
    unsetenv("CYCLONEDDS_URI");
    fs::remove_all(folder);
  }

  std::unique_ptr<test::Process> probe(const std::string& what, bool with_certificates) const {
    const std::string uri = "file://" + (folder / "keys" / "loopback.xml").string();
    if (with_certificates)
      setenv("CYCLONEDDS_URI", uri.c_str(), 1);
    else
      unsetenv("CYCLONEDDS_URI");
    return std::make_unique<test::Process>(
        std::vector<std::string>{PROBE, what, std::to_string(test::own_domain())}, (folder / what).string());
  }

  fs::path folder = fs::temp_directory_path() / ("palpate_security_" + std::to_string(getpid()));
};

TEST_F(Security, WhoHasCertificatesTalks) {
  const auto echo = probe("echo", true);
  const auto talk = probe("talk", true);
  EXPECT_EQ(talk->wait(), 0);
  EXPECT_EQ(echo->wait(), 0);
  EXPECT_THAT(talk->text(), HasSubstr("status=1 chunks=40"));
}

// The probe gives up after ten seconds without a partner.
TEST_F(Security, WhoHasNoneHearsNothing) {
  const auto echo = probe("echo", true);
  EXPECT_EQ(probe("talk", false)->wait(), 1);
}

TEST_F(Security, WhoHasNoneIsNotHeard) {
  const auto echo = probe("echo", false);
  EXPECT_EQ(probe("talk", true)->wait(), 1);
}

TEST_F(Security, KeepsAnIdentityThatIsThere) {
  test::Process again({MAKE_CERTIFICATES, (folder / "keys").string()}, (folder / "again").string());
  EXPECT_EQ(again.wait(), 2);
  EXPECT_THAT(again.text(), HasSubstr("holds an identity already"));
}

}  // namespace
}  // namespace palpate
