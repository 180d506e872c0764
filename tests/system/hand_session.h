#pragma once
// palpate-physics and palpate-haptic as processes of their own with the watched driver, and a test that stops, kills and
// starts them. Unless a test has a scene of its own, a rigid hand presses a block by 4 mm 1.3 s after forces are on, holds,
// and leaves and returns 5 s later.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "common/time/clock.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "tests/support/devices/watched_device.h"
#include "tests/system/block_scene.h"
#include "tests/system/dds_domain.h"
#include "tests/system/patience.h"

namespace palpate::test {

using namespace std::chrono_literals;

class HandSession : public testing::Test {
 protected:
  virtual std::string scene() const {
    return block_scene(250, 10,
                       "[0, 0, 0, 24], [0.8, 0, 0, 22], [1.3, 0, 0, 16], [6.3, 0, 0, 16], [6.8, 0, 0, 26], "
                       "[7.3, 0, 0, 26], [8.3, 0, 0, 16]");
  }

  void SetUp() override {
    std::filesystem::create_directories(folder / "out");
    std::ofstream(folder / "scene.toml") << scene();
    setenv("PALPATE_DRIVERS", WATCHED_DRIVERS, 1);
  }
  void TearDown() override {
    for (const pid_t pid : {physics, haptic}) end(pid, SIGKILL);
    std::filesystem::remove_all(folder);
  }

  pid_t start(const char* program) const {
    const std::string out = (folder / "out").string(), scene = (folder / "scene.toml").string();
    const std::string number = std::to_string(domain), log = (folder / "log").string();
    const pid_t pid = fork();
    if (pid != 0) return pid;
    if (std::freopen(log.c_str(), "a", stderr) == nullptr) _exit(126);
    execl(program, program, scene.c_str(), "--out", out.c_str(), "--domain", number.c_str(), nullptr);
    _exit(127);
  }
  void start_physics() { physics = start(PALPATE_PHYSICS); }
  void start_both() {
    start_physics();
    haptic = start(PALPATE_HAPTIC);
  }

  /// @return how it ended, as waitpid tells
  static int end(pid_t& pid, int signal) {
    if (pid <= 0) return 0;
    if (signal != 0) kill(pid, signal);
    int status = 0;
    waitpid(pid, &status, 0);
    pid = -1;
    return status;
  }
  static int end(const pid_t& pid, int signal) {
    pid_t copy = pid;
    return end(copy, signal);
  }

  /// Waits until `done`, as long as there is patience.
  static bool until(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }
  double force_now() const { return device->writes == 0 ? 0.0 : device->at(device->writes - 1).norm; }
  /// In contact, the hand at rest: 4 mm deep.
  bool presses() {
    return until([this] {
      const std::uint64_t n = device->writes;
      return n > 200 && device->at(n - 1).norm > 0.3 && device->at(n - 1).z == device->at(n - 100).z;
    });
  }

  std::string log() const {
    std::ifstream file(folder / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Whatever happened: in no tick does the force rise by more than 0.1 N beyond what the hand's own motion makes, from
  /// what the hand felt before. A device without power, or silent for longer than its own watchdog, forces nothing.
  void expect_no_kick() const {
    const std::uint64_t n_writes = device->writes;
    ASSERT_LE(n_writes, WatchedDevice::kept);
    for (std::uint64_t n = 1; n < n_writes; ++n) {
      const auto &before = device->at(n - 1), &now = device->at(n);
      if (now.powered == 0) continue;
      const bool let_go = before.powered == 0 || now.t_ns - before.t_ns > 30'000'000;
      const double rise = now.norm - (let_go ? 0.0 : before.norm);
      ASSERT_LE(rise, 0.1 + block_stiffness * std::abs(now.z - before.z) + 1e-9)
          << "write " << n << ", " << seconds_from_ns(now.t_ns - device->at(0).t_ns) << " s, gap "
          << 1e-6 * static_cast<double>(now.t_ns - before.t_ns) << " ms";
    }
  }

  int domain = own_domain();
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("palpate_hand_" + std::to_string(getpid()));
  WatchedFile device{"/dev/shm/palpate_hand_" + std::to_string(getpid()), WatchedFile::Role::test};
  pid_t physics = -1, haptic = -1;
};

}  // namespace palpate::test
