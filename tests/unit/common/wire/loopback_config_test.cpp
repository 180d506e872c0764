#include "common/wire/loopback_config.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace palpate {
namespace {

TEST(LoopbackConfig, IsTheTextOfTheFileThatIsInstalled) {
  const char* source = std::getenv("PALPATE_SOURCE");
  std::ifstream file(std::string(source == nullptr ? "." : source) + "/deploy/cyclonedds/loopback.xml");
  ASSERT_TRUE(file);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), loopback_config());
}

TEST(LoopbackConfig, AdmitsAsManyParticipantsAsItSays) {
  const std::string element = "<MaxAutoParticipantIndex>" + std::to_string(max_participants) + "<";
  EXPECT_NE(loopback_config().find(element), std::string_view::npos);
}

TEST(DiscoveryPort, FollowsTheStandard) {
  EXPECT_EQ(discovery_port(0, 0), 7410);
  EXPECT_EQ(discovery_port(0, 1), 7412);
  EXPECT_EQ(discovery_port(100, 3), 32416);
}

}  // namespace
}  // namespace palpate
