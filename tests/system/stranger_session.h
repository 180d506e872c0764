#pragma once
// palpate-physics and palpate-haptic with a driver whose vendor's library, or service, is a stranger's (stranger_bus.h): a
// hand presses a block, and the test strikes and looks at what the hardware does.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "tests/support/devices/stranger_bus.h"
#include "tests/system/block_scene.h"
#include "tests/system/dds_domain.h"

namespace palpate::test {

using namespace std::chrono_literals;

/// How late this machine lets a thread be: what it does to the test it does to the program, too.
class Metronome {
 public:
  Metronome() : thread_([this] { beat(); }) {}
  ~Metronome() {
    end_.store(true);
    thread_.join();
  }
  Metronome(const Metronome&) = delete;
  Metronome& operator=(const Metronome&) = delete;
  double most_ms() const { return 1e-6 * static_cast<double>(most_ns_.load()); }

 private:
  void beat() {
    for (std::int64_t due = bus_time_ns(); !end_.load(); due = bus_time_ns() + 1'000'000) {
      while (bus_time_ns() < due) std::this_thread::sleep_for(std::chrono::nanoseconds(due - bus_time_ns()));
      most_ns_.store(std::max(most_ns_.load(), bus_time_ns() - due));
    }
  }
  std::atomic<bool> end_{false};
  std::atomic<std::int64_t> most_ns_{0};
  std::thread thread_;
};

/// For how long the threads of a process have waited for a core so far, although they were ready [ms]; 0: there is none.
inline double waited_for_core_ms(pid_t pid) {
  double sum_ns = 0;
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", pid), gone)) {
    double ran = 0, waited = 0;
    if (std::ifstream(task.path() / "schedstat") >> ran >> waited) sum_ns += waited;
  }
  return 1e-6 * sum_ns;
}

class StrangerSession : public testing::Test {
 protected:
  /// A process that stands in for hardware; 0: the hardware is a library in the node.
  virtual pid_t service_pid() const { return 0; }
  /// What follows "[device.hand]" in the scene.
  virtual std::string device() const = 0;

  void SetUp() override {
    std::filesystem::create_directories(folder / "out");
    const std::string whole = block_scene(250, 10, "[0, 0, 0, 24]");
    std::ofstream(folder / "scene.toml") << whole.substr(0, whole.find("[device.hand]")) << "[device.hand]\n"
                                         << device() << "force_limit_N = 3\noffset_mm = [0, 0, 23]\n";
    bus->depth_mm.store(7);  // of which 4 are in the block
    physics = start(PALPATE_PHYSICS);
  }
  void TearDown() override {
    for (const pid_t pid : {haptic, physics})
      if (pid > 0) kill(pid, SIGKILL), waitpid(pid, nullptr, 0);
    std::filesystem::remove_all(folder);
  }

  pid_t start(const char* program) const {
    const std::string scene = (folder / "scene.toml").string(), number = std::to_string(domain);
    const std::string out = (folder / "out").string(), log = (folder / "log").string();
    const pid_t pid = fork();
    if (pid != 0) return pid;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed leaves nobody behind
    if (std::freopen(log.c_str(), "a", stderr) == nullptr) _exit(126);
    execl(program, program, scene.c_str(), "--out", out.c_str(), "--domain", number.c_str(), nullptr);
    _exit(127);
  }

  static bool until(const std::function<bool()>& done) {
    for (int i = 0; i < 10'000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }

  /// A new hand, which presses.
  bool presses() {
    bus->trouble.store(StrangerBus::none);
    haptic = start(PALPATE_HAPTIC);
    int in_a_row = 0;
    return until([&] {
             in_a_row = bus->felt() > 0.3 ? in_a_row + 1 : 0;
             return in_a_row > 25 || waitpid(haptic, nullptr, WNOHANG) != 0;
           }) &&
           in_a_row > 25;
  }

  struct Outcome {
    int status = 0;      // as waitpid tells
    double off_ms = -1;  // from the strike until the hardware was told no force, or off; below 0: never
    double gone_ms = 0;  // until the process had gone
    bool stayed_off = true;
    double late_ms = 0;  // of the machine meanwhile
  };
  /// @param wait_s  for what comes after the process has gone
  Outcome strike(const std::function<void()>& blow, double wait_s = 0.05) {
    Outcome outcome;
    const Metronome metronome;
    const double waited_ms = waited_for_core_ms(service_pid());
    const std::uint64_t first = bus->n_packets.load();
    const std::int64_t struck_ns = bus_time_ns();
    blow();
    EXPECT_TRUE(until([&] { return waitpid(haptic, &outcome.status, WNOHANG) != 0; })) << "still there";
    if (kill(haptic, SIGKILL) == 0) waitpid(haptic, &outcome.status, 0);
    haptic = -1;
    outcome.gone_ms = 1e-6 * static_cast<double>(bus_time_ns() - struck_ns);
    until([&] {
      return bus->felt() == 0 || bus_time_ns() - struck_ns > static_cast<std::int64_t>(1e9 * wait_s);
    });
    std::this_thread::sleep_for(20ms);
    // Hardware does not wait for a core; a process that stands in for it does.
    outcome.late_ms = metronome.most_ms() + waited_for_core_ms(service_pid()) - waited_ms;
    for (std::uint64_t n = first; n < bus->n_packets.load(); ++n) {
      const auto& packet = bus->packets[n % StrangerBus::kept];
      if (outcome.off_ms < 0 && packet.newton == 0 && packet.t_ns >= struck_ns)
        outcome.off_ms = 1e-6 * static_cast<double>(packet.t_ns - struck_ns);
      if (outcome.off_ms >= 0 && packet.newton != 0) outcome.stayed_off = false;
    }
    if (bus->felt() != 0) outcome.stayed_off = false;
    return outcome;
  }

  std::string log() const {
    std::ifstream file(folder / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string breaches() const {
    std::string all;
    for (std::uint32_t i = 0; i < std::min<std::uint32_t>(bus->n_breaches.load(), 16); ++i)
      all += std::string(bus->breaches[i].data()) + "\n";
    return all;
  }

  int domain = own_domain();
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("palpate_stranger_" + std::to_string(getpid()));
  StrangerBusFile bus{"/dev/shm/palpate_stranger_" + std::to_string(getpid())};
  pid_t physics = -1, haptic = -1;
};

}  // namespace palpate::test
