// Writers and readers over real loopback sockets.

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "common/error/error.h"
#include "common/wire/convert.h"
#include "common/wire/loopback_sockets.h"
#include "common/wire/reader.h"
#include "common/wire/topic.h"
#include "common/wire/writer.h"
#include "tests/system/dds_domain.h"
#include "tests/system/patience.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate {
namespace {

using namespace std::chrono_literals;
using test::random_message;

/// Calls `done` every millisecond until it is true. @return false if that takes too long
template <class Done>
bool eventually(Done done) {
  const auto end = std::chrono::steady_clock::now() + test::patience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

template <class M>
class Wire : public testing::Test {};
using AllMessages = testing::Types<ToolState, ContactPatch, ToolWrench, BodySurface, SurfaceChange,
                                   VertexBlock, HapticTrace, Pointer, Command, NodeStatus>;
TYPED_TEST_SUITE(Wire, AllMessages);

TEST(WireWriter, CountsAReaderThatComesAsAnotherLeaves) {
  Participant participant(test::own_domain());
  Writer<VertexBlock> writer(participant);
  EXPECT_EQ(writer.matched_ever(), 0U);
  auto reader = std::make_unique<Reader<VertexBlock>>(participant);
  ASSERT_TRUE(eventually([&] { return writer.matched() == 1; }));
  EXPECT_EQ(writer.matched_ever(), 1U);
  reader.reset();
  reader = std::make_unique<Reader<VertexBlock>>(participant);
  EXPECT_TRUE(eventually([&] { return writer.matched() == 1 && writer.matched_ever() == 2; }));
}

TYPED_TEST(Wire, CarriesAMessageFromWriterToReader) {
  Participant participant(test::own_domain());
  Writer<TypeParam> writer(participant);
  EXPECT_EQ(writer.matched(), 0);
  Reader<TypeParam> reader(participant);
  ASSERT_TRUE(eventually([&] { return writer.matched() == 1 && reader.matched() == 1; }));
  const auto sent = std::make_unique<TypeParam>(random_message<TypeParam>(5));
  const auto got = std::make_unique<TypeParam>();
  EXPECT_FALSE(reader.take(*got));
  ASSERT_TRUE(writer.write(*sent));
  ASSERT_TRUE(reader.wait(test::patience));
  ASSERT_TRUE(reader.take(*got));
  EXPECT_TRUE(*sent == *got);
  EXPECT_FALSE(reader.take(*got));
  EXPECT_FALSE(reader.wait(1ms));
  EXPECT_EQ(reader.counts().received, 1U);
}

TEST(WireService, GivesTheNewestOfALatestValueTopicPerTool) {
  Participant participant(test::own_domain());
  Writer<ToolState> writer(participant);
  Reader<ToolState> reader(participant);
  ASSERT_TRUE(eventually([&] { return writer.matched() == 1; }));
  ToolState state;
  for (state.tick = 1; state.tick <= 20; ++state.tick) {
    state.tool = static_cast<std::uint32_t>(state.tick % 2);
    ASSERT_TRUE(writer.write(state));
  }
  std::array<std::uint64_t, 2> newest{};
  ASSERT_TRUE(eventually([&] {
    while (reader.take(state)) newest[state.tool] = state.tick;
    return newest[0] == 20 && newest[1] == 19;
  }));
  for (state.tick = 21; state.tick <= 24; ++state.tick) {
    state.tool = static_cast<std::uint32_t>(state.tick % 2);
    ASSERT_TRUE(writer.write(state));
  }
  ASSERT_TRUE(reader.take_newest(state));
  EXPECT_EQ(state.tick, 24U);
  EXPECT_FALSE(reader.take_newest(state));
}

TEST(WireService, TellsWhenAnotherWriterTakesOver) {
  Participant participant(test::own_domain());
  Reader<ToolState> reader(participant);
  EXPECT_EQ(reader.sender(), 0U);
  std::array<std::uint64_t, 2> senders{};
  for (auto& sender : senders) {
    Writer<ToolState> writer(participant);
    ASSERT_TRUE(eventually([&] { return writer.matched() == 1; }));
    for (int i = 0; i < 2; ++i) {
      ToolState state;
      ASSERT_TRUE(writer.write(state));
      ASSERT_TRUE(eventually([&] { return reader.take(state); }));
      EXPECT_TRUE(i == 0 || reader.sender() == sender) << "the same one";
      sender = reader.sender();
    }
  }
  EXPECT_NE(senders[0], 0U);
  EXPECT_NE(senders[0], senders[1]);
}

TEST(WireService, KeepsAllBatchesAndCommandsInOrder) {
  Participant participant(test::own_domain());
  Writer<HapticTrace> traces(participant);
  Reader<HapticTrace> trace_reader(participant);
  Writer<Command> commands(participant);
  Reader<Command> command_reader(participant);
  ASSERT_TRUE(eventually([&] { return traces.matched() == 1 && commands.matched() == 1; }));
  HapticTrace trace;
  Command command;
  for (std::uint64_t i = 0; i < 60; ++i) {
    trace.batch = command.id = i;
    ASSERT_TRUE(traces.write(trace));
    ASSERT_TRUE(commands.write(command));
  }
  for (std::uint64_t i = 0; i < 60; ++i) {
    ASSERT_TRUE(eventually([&] { return trace_reader.take(trace); })) << i;
    EXPECT_EQ(trace.batch, i);
    ASSERT_TRUE(eventually([&] { return command_reader.take(command); })) << i;
    EXPECT_EQ(command.id, i);
  }
}

TEST(WireService, GivesALateJoinerTheWholeSurface) {
  constexpr std::uint32_t n_chunks = 40;
  Participant participant(test::own_domain());
  Writer<BodySurface> writer(participant);
  const auto chunk = std::make_unique<BodySurface>();
  chunk->body = 3;
  chunk->revision = 2;
  chunk->n_chunks = n_chunks;
  chunk->total_vertices = n_chunks * max_surface_vertices;
  chunk->n_vertices = max_surface_vertices;
  for (std::uint32_t i = 0; i < n_chunks; ++i) {
    chunk->chunk = i;
    chunk->first_vertex = i * max_surface_vertices;
    for (auto& p : chunk->position) p[0] = static_cast<float>(i);
    ASSERT_TRUE(writer.write(*chunk));
  }
  Reader<BodySurface> late(participant);
  std::array<int, n_chunks> seen{};
  std::uint32_t n = 0;
  ASSERT_TRUE(eventually([&] {
    while (late.take(*chunk)) {
      EXPECT_EQ(chunk->position[max_surface_vertices - 1][0], static_cast<float>(chunk->chunk));
      ++seen[chunk->chunk];
      ++n;
    }
    return n >= n_chunks;
  }));
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(WireService, RefusesToSendABrokenMessage) {
  Participant participant(test::own_domain());
  Writer<ContactPatch> writer(participant);
  Reader<ContactPatch> reader(participant);
  ASSERT_TRUE(eventually([&] { return writer.matched() == 1; }));
  ContactPatch patch;
  patch.n_facets = max_patch_facets + 1;
  EXPECT_FALSE(writer.write(patch));
  patch.n_facets = 1;
  patch.facets[0].normal = {0, 0, 1};
  patch.facets[0].stiffness = std::nan("");
  EXPECT_FALSE(writer.write(patch));
  EXPECT_FALSE(reader.wait(50ms));
}

TEST(WireService, DropsAndCountsWhatAStrangerSendsBroken) {
  Participant participant(test::own_domain());
  Reader<ToolState> reader(participant);
  const Qos qos = make_qos(Topic<ToolState>::service);
  const dds_entity_t topic =
      dds_create_topic(participant.handle(), Topic<ToolState>::descriptor(), "ToolState", qos.get(), nullptr);
  const dds_entity_t stranger = dds_create_writer(participant.handle(), topic, qos.get(), nullptr);
  ASSERT_GT(stranger, 0);
  ASSERT_TRUE(eventually([&] { return reader.matched() == 1; }));
  palpate_wire_ToolState wire = {};
  const auto send = [&](std::uint32_t version, std::uint32_t tool, double force) {
    wire.version = version;
    wire.tool = tool;
    wire.q_WT[0] = 1;
    wire.force_on_hand[1] = force;
    ASSERT_EQ(dds_write(stranger, &wire), DDS_RETCODE_OK);
  };
  // Different tools: on a latest-value topic the second sample of one tool would replace the first.
  send(wire_version + 1, 1, 0);
  send(wire_version, 2, std::nan(""));
  send(wire_version, max_tools, 0);
  send(wire_version, 4, 0.5);
  ToolState got;
  ASSERT_TRUE(eventually([&] { return reader.take(got); }));
  EXPECT_EQ(got.tool, 4U);
  ASSERT_TRUE(eventually([&] {
    reader.take(got);
    const auto rejected = reader.counts().rejected;
    return rejected[static_cast<std::size_t>(RejectReason::version)] == 1 &&
           rejected[static_cast<std::size_t>(RejectReason::not_finite)] == 1 &&
           rejected[static_cast<std::size_t>(RejectReason::unknown_id)] == 1;
  }));
  EXPECT_EQ(reader.counts().received, 1U);
}

TEST(WireService, JoinsTwoProcesses) {
  const int domain = test::own_domain();
  const std::string domain_text = std::to_string(domain);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(WIRE_ECHO, "wire_echo", domain_text.c_str(), nullptr);
    _exit(127);
  }
  Participant participant(domain);
  Writer<ToolState> tools(participant);
  Reader<ContactPatch> patches(participant);
  ASSERT_TRUE(eventually([&] { return tools.matched() == 1 && patches.matched() == 1; }));
  ToolState state;
  ContactPatch patch;
  std::vector<double> round_us;
  for (state.tick = 1; state.tick <= 500; ++state.tick) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(tools.write(state));
    if (!patches.wait(100ms) || !patches.take_newest(patch)) continue;
    round_us.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    EXPECT_LE(patch.answers, state.tick);
  }
  ASSERT_GT(round_us.size(), 250U) << "most ticks must be answered";
  std::nth_element(round_us.begin(), round_us.begin() + static_cast<std::ptrdiff_t>(round_us.size() / 2),
                   round_us.end());
  RecordProperty("round_trip_us_p50", std::to_string(round_us[round_us.size() / 2]));
  state.buttons = 1;
  int status = -1;
  ASSERT_TRUE(eventually([&] { return tools.write(state), waitpid(child, &status, WNOHANG) == child; }));
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(Participant, HearsThisMachineOnly) {
  Participant participant(test::own_domain());
  EXPECT_TRUE(participant.local_only());
  const auto sockets = own_udp_sockets();
  EXPECT_GE(sockets.size(), 2U) << "one port to discover, one for data";
  for (const UdpSocket& socket : sockets) EXPECT_TRUE(socket.local_only()) << "port " << socket.port;
}

TEST(Participant, SharesItsDomainWithinAProcess) {
  auto first = std::make_unique<Participant>(test::own_domain());
  Participant second(test::own_domain());
  first.reset();
  Writer<Command> writer(second);
  Reader<Command> reader(second);
  EXPECT_TRUE(eventually([&] { return writer.matched() == 1; }));
}

TEST(Participant, NamesAMistakenDomainOrConfiguration) {
  EXPECT_THROW(Participant(101), InputError);
  EXPECT_THROW(Participant(-1), InputError);
  EXPECT_THROW(Participant(test::own_domain(), "/no/such/file.xml"), InputError);
}

}  // namespace
}  // namespace palpate
