// Nonsense on every topic into every node, from a process that says it is the one whose word counts there, and from one that
// says nothing: messages as they should be, some of their words and numbers replaced. The node goes on, answers within 10 s,
// takes no more memory than it may, writes no more than a few lines, and ends in order when it is asked to.
//
//   PALPATE_FLOOD=100000 build/ready/tests/wire_flood_test        # messages of each kind; a few hundred by default
//   PALPATE_FLOOD_TOPIC=BodySurface ...                            # of this kind only

#include <dds/dds.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "common/report/json_file.h"
#include "common/scene/load_scene.h"
#include "common/wire/convert.h"
#include "common/wire/reader.h"
#include "common/wire/topic.h"
#include "tests/system/block_scene.h"
#include "tests/system/dds_domain.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
constexpr auto hangs = 10s;
constexpr std::uintmax_t most_log = 100'000;  // bytes of what a node says

int messages_of_each() {
  const char* text = std::getenv("PALPATE_FLOOD");
  return text == nullptr ? 300 : std::atoi(text);
}

/// So that the sample is about something that is there, most of the time.
template <class M>
void aim(Dice& dice, M& m) {
  if constexpr (requires { m.tool; }) m.tool = dice.below(8) == 0 ? 1 : 0;
  if constexpr (requires { m.body; }) m.body = dice.below(8) == 0 ? 1 : 0;
}
/// Also surfaces that are whole with one chunk, and not more of them at once than a sender keeps.
void aim(Dice& dice, BodySurface& m) {
  m.body = 0;
  m.revision = 1 + static_cast<std::uint32_t>(dice.integer() % 1'000'000);
  m.chunk = m.first_vertex = m.first_facet = 0;
  if (dice.below(2) == 0) return;
  m.n_chunks = 1;
  m.total_vertices = m.n_vertices;
  m.total_facets = m.n_facets;
  for (std::uint32_t i = 0; i < m.n_facets; ++i)
    for (std::uint32_t& corner : m.corners[i]) corner %= m.n_vertices;
}
/// Also changes that are whole with one page.
void aim(Dice& dice, SurfaceChange& m) {
  m.body = 0;
  m.revision = 1 + static_cast<std::uint32_t>(dice.integer() % 1'000'000);
  if (dice.below(2) == 0) make_whole(m);
}
void aim(Dice& dice, VertexBlock& m) {
  m.body = 0;
  m.block = dice.below(64);
  m.first_vertex = m.block * max_block_vertices;
}

template <class Wire>
void spoil(Dice& dice, Wire& wire) {
  constexpr std::array<double, 9> numbers = {1e300, 1e17, -1e308, 1e9, 1e8, -1e3, 1e-310, HUGE_VAL, NAN};
  constexpr std::array<std::uint32_t, 8> words = {0, 1, 16, 64, 2048, 16384, 0x7fffffffU, 0xffffffffU};
  auto* bytes = reinterpret_cast<unsigned char*>(&wire);
  constexpr std::uint32_t head = sizeof(Wire) < 400 ? sizeof(Wire) : 400;
  for (std::uint32_t n = 1 + dice.below(3); n > 0; --n) {
    const std::uint32_t within = dice.below(2) == 0 ? head : sizeof(Wire);
    const double number = numbers[dice.below(numbers.size())];
    const std::uint32_t word =
        dice.below(2) == 0 ? words[dice.below(words.size())] : static_cast<std::uint32_t>(dice.integer());
    if (dice.below(2) == 0)
      std::memcpy(bytes + 8 * dice.below(within / 8), &number, sizeof number);
    else
      std::memcpy(bytes + 4 * dice.below(within / 4), &word, sizeof word);
  }
  if (dice.below(16) > 0) wire.version = wire_version;
}

/// Writes to one topic whatever there is to write.
template <class M>
class Flood {
 public:
  explicit Flood(const Identity& identity) {
    Membership membership;
    membership.domain = own_domain();
    membership.identity = identity;
    participant_ = std::make_unique<Participant>(membership);
    const Qos qos = make_qos(Topic<M>::service);
    const dds_entity_t topic = made(
        dds_create_topic(participant_->handle(), Topic<M>::descriptor(), Topic<M>::name, qos.get(), nullptr),
        "topic", Topic<M>::name);
    const std::string text = identity.role.empty() ? "" : to_text(identity);
    if (!text.empty()) dds_qset_userdata(qos.get(), text.data(), text.size());
    writer_ = made(dds_create_writer(participant_->handle(), topic, qos.get(), nullptr), "writer", "");
  }
  void send(Dice& dice) {
    randomise(dice, *message_);
    aim(dice, *message_);
    to_wire(*message_, *wire_);
    if (dice.below(2) == 0) spoil(dice, *wire_);
    if constexpr (std::is_same_v<M, Command>)
      if (wire_->kind == static_cast<std::uint32_t>(CommandKind::stop)) wire_->kind = 0;
    dds_write(writer_, wire_.get());
  }

 private:
  std::unique_ptr<Participant> participant_;
  std::unique_ptr<M> message_ = std::make_unique<M>();
  std::unique_ptr<typename Topic<M>::Wire> wire_ = std::make_unique<typename Topic<M>::Wire>();
  dds_entity_t writer_ = 0;
};

struct Node {
  const char* name;
  const char* program;
  NodeKind kind;
  std::size_t most_growth;  // of its memory [bytes]
};
void PrintTo(const Node& node, std::ostream* out) { *out << node.name; }

class WireFlood : public testing::TestWithParam<Node> {
 protected:
  void SetUp() override {
    fs::create_directories(folder / "out");
    std::ofstream(folder / "scene.toml") << block_scene(250, 20, "[0, 0, 0, 24], [600, 0, 0, 24]");
    identity = own_identity("", (folder / "scene.toml").string(),
                            load_scene((folder / "scene.toml").string(), {}).checksum);
    identity.host = "elsewhere";
    pid = start();
    ASSERT_TRUE(answers()) << log();
    std::this_thread::sleep_for(3500ms);  // a newcomer would go before one that says it has its role
    before = memory("VmRSS");
  }
  void TearDown() override {
    if (pid > 0) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
    fs::remove_all(folder);
  }

  pid_t start() const {
    const std::string out = (folder / "out").string(), scene = (folder / "scene.toml").string();
    const std::string number = std::to_string(own_domain()), file = (folder / "log").string();
    const pid_t child = fork();
    if (child != 0) return child;
    if (std::freopen(file.c_str(), "a", stderr) == nullptr) _exit(126);
    const char* program = GetParam().program;
    execl(program, program, scene.c_str(), "--out", out.c_str(), "--domain", number.c_str(), "--headless",
          nullptr);
    _exit(127);
  }
  std::string log() const {
    std::ifstream file(folder / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// A line of /proc/PID/status, in bytes.
  std::size_t memory(const std::string& what) const {
    std::ifstream file("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.rfind(what + ":", 0) == 0) return 1024 * std::stoul(line.substr(what.size() + 1));
    return 0;
  }
  /// A status made after now has come.
  bool answers() {
    NodeStatus status;
    while (statuses.take(status)) {
    }
    std::uint64_t first = 0;
    for (const auto end = Clock::now() + hangs; Clock::now() < end;) {
      if (waitpid(pid, nullptr, WNOHANG) == pid) {
        pid = -1;
        return false;
      }
      statuses.wait(20ms);
      while (statuses.take(status)) {
        if (status.node != GetParam().kind || status.pid != static_cast<std::uint32_t>(pid)) continue;
        newest = status;
        if (++first > 1) return true;
      }
    }
    return false;
  }

  template <class M>
  void flood(const std::string& role, std::uint64_t seed) {
    const char* only = std::getenv("PALPATE_FLOOD_TOPIC");
    if (only != nullptr && std::string(only) != Topic<M>::name) return;
    Dice dice(seed);
    Identity sender = identity;
    sender.role = role;
    if (role.empty()) sender = Identity{};
    Flood<M> flood(sender);
    std::this_thread::sleep_for(200ms);  // to be discovered
    const int n = messages_of_each();
    auto look = Clock::now() + 5s;
    for (int i = 0; i < n; ++i) {
      flood.send(dice);
      if (i % 20 == 19) std::this_thread::sleep_for(1ms);  // so that most of them are read
      if (Clock::now() < look) continue;
      ASSERT_TRUE(answers()) << Topic<M>::name << " " << role << "\n" << log();
      look = Clock::now() + 5s;
    }
    ASSERT_TRUE(answers()) << Topic<M>::name << " " << role << "\n" << log();
    std::printf("  %-8s %-12s %-8s %7d sent, memory at most %4zu MB, %4zu before\n", GetParam().name,
                Topic<M>::name, role.empty() ? "nobody" : role.c_str(), n, memory("VmHWM") >> 20U,
                before >> 20U);
    EXPECT_LE(memory("VmHWM"), before + GetParam().most_growth) << Topic<M>::name << " " << role;
  }

  fs::path folder = fs::path(testing::TempDir()) / ("palpate_flood_" + std::to_string(getpid()));
  Participant participant{own_domain()};
  Reader<NodeStatus> statuses{participant};
  Identity identity;
  pid_t pid = -1;
  std::size_t before = 0;
  NodeStatus newest;
};

TEST_P(WireFlood, LeavesTheNodeAliveAndSmall) {
  for (const bool believed : {true, false}) {
    const auto who = [&](const char* role) { return believed ? role : ""; };
    flood<ToolState>(who("haptic"), 1);
    flood<ContactPatch>(who("physics"), 2);
    flood<ToolWrench>(who("physics"), 3);
    flood<BodySurface>(who("physics"), 4);
    flood<VertexBlock>(who("physics"), 5);
    flood<HapticTrace>(who("haptic"), 6);
    flood<Pointer>(who("render"), 7);
    flood<Command>(who("render"), 8);
    flood<NodeStatus>(who("supervisor"), 9);
    flood<SurfaceChange>(who("physics"), 10);
    if (HasFatalFailure()) return;
  }
  std::uint64_t rejected = 0;
  for (const std::uint64_t n : newest.rejected) rejected += n;
  EXPECT_GT(rejected, 10U);
  EXPECT_NE(newest.refused[0], '\0') << "the first one is told";
  EXPECT_LE(fs::file_size(folder / "log"), most_log);

  kill(pid, SIGTERM);
  int status = 0;
  for (const auto end = Clock::now() + hangs; waitpid(pid, &status, WNOHANG) == 0;) {
    ASSERT_LT(Clock::now(), end) << "does not end\n" << log();
    std::this_thread::sleep_for(5ms);
  }
  pid = -1;
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  const auto part = read_json((folder / "out" / "parts" / (std::string(GetParam().name) + ".json")).string());
  EXPECT_FALSE(part.at("wire").at(GetParam().name).at("heard").empty());
}

constexpr std::size_t MB = std::size_t{1} << 20;
INSTANTIATE_TEST_SUITE_P(Nodes, WireFlood,
                         testing::Values(Node{"physics", PALPATE_PHYSICS, NodeKind::physics, 100 * MB},
                                         Node{"haptic", PALPATE_HAPTIC, NodeKind::haptic, 100 * MB},
                                         Node{"render", PALPATE_RENDER, NodeKind::render, 400 * MB}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace palpate::test
