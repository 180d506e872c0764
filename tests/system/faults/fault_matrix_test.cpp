// A session under load whose nodes are killed, ended, stopped and started again at random moments, most of them while the
// hand presses. After each the hand has felt no kick, has lost its force where it had lost its source, and all who live
// have found each other again.
//   PALPATE_FAULTS=200      faults in this run; else a few
//   PALPATE_FAULT_SEED=N    the run of before

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <thread>

#include "common/time/clock.h"
#include "tests/system/dds_domain.h"
#include "tests/system/faults/fault_table.h"
#include "tests/system/faults/footprint.h"
#include "tests/system/faults/hand_log.h"
#include "tests/system/faults/node_crew.h"
#include "tests/system/faults/pressing_scene.h"
#include "tests/system/faults/session_ear.h"
#include "tests/system/patience.h"

namespace palpate::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double lost_within_s = 0.4;       // 0 N after the hand has lost its source
constexpr double device_lets_go_s = 0.035;  // the device's own watchdog and a tick or two

int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

class FaultMatrix : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "scene.toml") << pressing_scene();
    setenv("PALPATE_DRIVERS", WATCHED_DRIVERS, 1);
    load = std::thread([this] {
      setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()),
                  0);  // an ordinary program, whatever the nodes are
      while (!calm.load()) {
      }
    });
  }
  void TearDown() override {
    calm.store(true);
    load.join();
    for (const NodeKind node : crew_nodes) crew.kill_now(node);
    fs::remove_all(folder);
  }

  /// Looks and listens until `done`. @return false after `patience_s`
  bool until(const std::function<bool()>& done,
             double patience_s = std::chrono::duration<double>(patience).count()) {
    for (const std::int64_t begin_ns = now_ns(); seconds_from_ns(now_ns() - begin_ns) < patience_s;) {
      ear->listen();
      hand.read();
      if (done()) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  void let_pass(double seconds) {
    until([] { return false; }, seconds);
  }
  double random(double from, double to) { return std::uniform_real_distribution<double>(from, to)(dice); }

  std::int64_t start(NodeKind node) {
    if (node == NodeKind::haptic) ear->expect_new_traces();
    const std::int64_t start_ns = now_ns();
    crew.start(node);
    return start_ns;
  }
  bool is_back(NodeKind node, std::int64_t since_ns, std::uint64_t pictures) {
    return node == NodeKind::render ? ear->draws(crew.pid(node), pictures) : ear->answered_since(since_ns);
  }

  int end(NodeKind node, int number);
  std::int64_t strike(const FaultResult& result);
  void look_at_silence(FaultResult& result, std::int64_t fault_ns, std::int64_t source_ns);
  FaultResult fault();

  int domain = own_domain();
  std::string name = "palpate_faults_" + std::to_string(getpid());
  fs::path folder =
      fs::path("/dev/shm") / (name + "_files");  // in memory: a disk that others keep busy is another fault
  WatchedFile device{"/dev/shm/" + name, WatchedFile::Role::test};
  NodeCrew crew{PROGRAMS, folder, domain};
  HandLog hand{*device, block_stiffness, block_force_limit};
  std::unique_ptr<SessionEar> ear = std::make_unique<SessionEar>(domain);
  Growth growth;
  bool hurried = false;  // what happened last has not been met yet
  std::atomic<bool> calm{false};
  std::thread load;
  std::mt19937_64 dice;
};

/// Tells a node to end and goes on listening meanwhile. @return how it ended, as waitpid tells
int FaultMatrix::end(NodeKind node, int number) {
  crew.signal(node, number);
  int status = 0;
  EXPECT_TRUE(until([&] { return crew.has_ended(node, status); })) << name_of(node) << " does not end";
  return status;
}

/// Does it to the node, waits as the kind has it, and lets it be again.
/// @return when it was started again or went on
std::int64_t FaultMatrix::strike(const FaultResult& result) {
  switch (result.kind) {
    case FaultKind::killed:
      end(result.node, SIGKILL);
      return start(result.node);
    case FaultKind::ended: {
      const int status = end(result.node, SIGTERM);
      const bool too_early = hurried && WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM;  // no handler yet
      EXPECT_TRUE(too_early || (WIFEXITED(status) && WEXITSTATUS(status) == 0))
          << name_of(result.node) << ": " << status;
      return start(result.node);
    }
    case FaultKind::away:
      end(result.node, SIGKILL);
      let_pass(random(0.5, 3));
      return start(result.node);
    case FaultKind::stopped:
      crew.signal(result.node, SIGSTOP);
      let_pass(std::exp(random(std::log(0.005), std::log(2.0))));
      crew.signal(result.node, SIGCONT);
      return now_ns();
  }
  return 0;
}

/// Who held the force was away from `fault_ns` to `source_ns`: it must be 0 N in time, and stay so.
void FaultMatrix::look_at_silence(FaultResult& result, std::int64_t fault_ns, std::int64_t source_ns) {
  const double away_s = seconds_from_ns(source_ns - fault_ns);
  if (!result.in_contact) return;
  if (result.node == NodeKind::physics && away_s > lost_within_s) {
    result.to_no_force = seconds_from_ns(hand.last_force(fault_ns, source_ns) - fault_ns);
    EXPECT_LE(*result.to_no_force, lost_within_s) << "a force without a source";
  }
  if (result.node == NodeKind::haptic && result.kind == FaultKind::stopped && away_s > device_lets_go_s) {
    ASSERT_TRUE(until([&] { return hand.felt_after(source_ns).has_value(); }));
    EXPECT_EQ(*hand.felt_after(source_ns), 0.0) << "the device's own watchdog lets go";
  }
}

/// One fault of a random node at this moment, up to when it has been met.
FaultResult FaultMatrix::fault() {
  FaultResult result;
  result.node = crew_nodes[static_cast<std::size_t>(random(0, 3))];
  result.kind = static_cast<FaultKind>(static_cast<int>(random(0, 4)));
  result.in_contact = hand.force() > 0.1;
  hand.take_largest_rise();
  const std::uint64_t pictures = result.kind == FaultKind::stopped ? ear->pictures(crew.pid(result.node)) : 0;
  const std::size_t logged = crew.log().size();
  const std::int64_t fault_ns = now_ns();
  const std::int64_t source_ns = strike(result);
  hurried = random(0, 8) < 1;  // the next fault comes while this one is being met
  if (hurried) {
    let_pass(random(0, 0.3));
  } else {
    EXPECT_TRUE(until([&] { return is_back(result.node, source_ns, pictures); }))
        << name_of(result.node) << " (" << crew.pid(result.node) << "), " << name_of(result.kind)
        << ": has not come back; newest picture: " << ear->eye().ticks << " of process " << ear->eye().pid
        << ", phase " << static_cast<int>(ear->eye().phase) << ", " << ear->eye().samples_received
        << " messages heard";
    result.to_rejoin = seconds_from_ns(now_ns() - source_ns);
    if (*result.to_rejoin > 1)
      std::printf("%s, %s: back after %.2f s\n%s", name_of(result.node), name_of(result.kind),
                  *result.to_rejoin, crew.log().substr(logged).c_str());
  }
  look_at_silence(result, fault_ns, source_ns);
  result.rise = hand.take_largest_rise();
  return result;
}

TEST_F(FaultMatrix, NoKickNoCrashNoLeakAndAllFindEachOtherAgain) {
  const int n_faults = number_from("PALPATE_FAULTS", 12);
  const auto seed =
      static_cast<unsigned>(number_from("PALPATE_FAULT_SEED", static_cast<int>(std::random_device()() >> 1)));
  std::printf("PALPATE_FAULT_SEED=%u\n", seed);
  dice.seed(seed);
  for (const NodeKind node : crew_nodes) start(node);
  ASSERT_TRUE(until([&] { return hand.force() > 0.3 && ear->draws(crew.pid(NodeKind::render), 0); }))
      << crew.log();

  FaultTable table;
  std::uint64_t gaps = 0;
  for (int n = 0; n < n_faults && !HasFailure(); ++n) {
    SCOPED_TRACE("fault " + std::to_string(n) + " of seed " + std::to_string(seed));
    table.add(fault());
    const auto crashed = crew.crashed();
    EXPECT_TRUE(crashed.empty()) << crashed.front() << '\n' << crew.log();
    EXPECT_EQ(hand.trouble(), "");
    if (ear->trace_gaps() > gaps)
      std::printf("fault %d, %s, %s: %llu samples of traces are missing\n", n,
                  name_of(table.results().back().node), name_of(table.results().back().kind),
                  static_cast<unsigned long long>(ear->trace_gaps() - gaps));
    gaps = ear->trace_gaps();
    if (hurried) continue;
    for (const NodeKind node : crew_nodes) growth.look(crew.pid(node));
    growth.look(getpid());
    // The next moment: mostly while the hand presses, sometimes anywhere.
    EXPECT_TRUE(until([&] { return hand.force() > 0.3; }))
        << "nothing is felt any more: " << ear->hand().note.data();
    let_pass(random(0, random(0, 4) < 1 ? 1.0 : 0.4));
  }
  std::printf("%s", table.text().c_str());
  const Footprint growth_of_nodes = growth.largest();
  const std::string grown = growth.text();
  std::printf(
      "%zu faults, %d in contact; longest to 0 N %.0f ms; rejoined %d of %d within 1 s, longest %.2f s; %llu "
      "writes to "
      "the device, %llu samples of traces, %llu missing; %zu processes looked at 8 times: +%d files, +%d "
      "threads, "
      "+%ld kB\n",
      table.results().size(), table.in_contact(), 1e3 * table.longest_to_no_force(), table.rejoins(1),
      table.rejoins(), table.longest_to_rejoin(), static_cast<unsigned long long>(hand.writes()),
      static_cast<unsigned long long>(ear->trace_samples()),
      static_cast<unsigned long long>(ear->trace_gaps()), growth.processes(), growth_of_nodes.files,
      growth_of_nodes.threads, growth_of_nodes.memory_kB);

  // A node that the last fault has only just started again is ended by the signal itself.
  EXPECT_TRUE(until([&] { return hand.force() > 0.3 && ear->draws(crew.pid(NodeKind::render), 0); }))
      << crew.log();
  for (const NodeKind node : crew_nodes) {
    const int status = end(node, SIGTERM);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << name_of(node) << " " << status << '\n'
                                                               << crew.log();
  }
  ear.reset();
  std::set<std::string> shared = growth.shared();
  const std::set<std::string> own = footprint(getpid()).shared;  // where our own output goes
  std::erase_if(shared, [&](const std::string& path) {
    return own.contains(path) || path.find(name) != std::string::npos || lies_in({SOURCE, BUILD}, path);
  });
  const auto left = left_behind(shared, crew.ever(), domain);
  EXPECT_TRUE(left.empty()) << left.front();
  EXPECT_EQ(growth_of_nodes.files, 0) << grown;
  EXPECT_EQ(growth_of_nodes.threads, 0) << grown;
}

}  // namespace
}  // namespace palpate::test
