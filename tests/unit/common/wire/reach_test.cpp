// Which way to the other PC, in what words a mistake is told, and what DDS is then told.

#include "common/wire/reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/wire/network_config.h"

namespace palpate {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string complaint(const Reach& reach) {
  try {
    resolve(reach);
  } catch (const InputError& error) {
    return error.complaints().front();
  }
  return {};
}

TEST(Reach, IsLocalUnlessAPersonAsksForMore) {
  EXPECT_TRUE(Reach().local());
  EXPECT_TRUE((Reach{"lo", {}}.local()));
  EXPECT_TRUE((Reach{"127.0.0.1", {"192.0.2.1"}}.local()));
  EXPECT_FALSE((Reach{"eth0", {}}.local()));
  EXPECT_FALSE((Reach{"", {"192.0.2.1"}}.local()));
  EXPECT_EQ(resolve({}).interface, "lo");
}

TEST(Reach, NamesWhatIsNotThere) {
  EXPECT_THAT(complaint({"eth77", {}}), HasSubstr("--interface: \"eth77\" is no interface that is up"));
  EXPECT_THAT(complaint({"eth77", {}}), HasSubstr("lo (127.0.0.1)"));
  EXPECT_THAT(complaint({"", {"no.such.host.invalid"}}),
              HasSubstr("--peers: \"no.such.host.invalid\" cannot be found"));
}

TEST(Reach, FindsTheInterfaceToAPeer) {
  const Route route = resolve({"", {"127.0.0.9"}});
  EXPECT_EQ(route.interface, "lo");
  ASSERT_EQ(route.peers.size(), 1U);
  EXPECT_EQ(address_text(route.peers[0]), "127.0.0.9");
}

TEST(CommaList, LeavesEmptyWordsOut) {
  EXPECT_EQ(comma_list("a,,b,"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(comma_list("").empty());
}

TEST(NetworkConfig, UsesThePeersOrMulticastNeverBoth) {
  Route route{"eth3", 4, 0x0a000001, {0x0a000002}};
  const std::string listed = network_config(route);
  EXPECT_THAT(listed, HasSubstr("NetworkInterface name=\"eth3\" multicast=\"false\""));
  EXPECT_THAT(listed, HasSubstr("<AllowMulticast>false<"));
  EXPECT_THAT(listed, HasSubstr("<Peer Address=\"10.0.0.2\"/>"));
  EXPECT_THAT(listed, HasSubstr("<Peer Address=\"10.0.0.1\"/>"))
      << "the nodes of one PC must find each other";
  route.peers.clear();
  const std::string open = network_config(route);
  EXPECT_THAT(open, HasSubstr("<AllowMulticast>spdp<"));
  EXPECT_THAT(open, Not(HasSubstr("<Peer ")));
}

}  // namespace
}  // namespace palpate
