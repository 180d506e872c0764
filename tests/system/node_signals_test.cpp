// The signals that end palpate-haptic sent to physics and render: each ends at once by that signal, or in order; none hangs,
// and what physics has recorded can be read.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/block_scene.h"
#include "tests/system/dds_domain.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class NodeSignals : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder / "out");
    std::ofstream(folder / "scene.toml") << test::block_scene(250, 10, "[0, 0, 0, 24], [9, 0, 0, 24]");
  }
  void TearDown() override {
    if (pid > 0) kill(pid, SIGKILL), waitpid(pid, nullptr, 0);
    fs::remove_all(folder);
  }
  void start(const char* program, const char* flag = nullptr) {
    const std::string scene = (folder / "scene.toml").string(), out = (folder / "out").string();
    const std::string number = std::to_string(test::own_domain()), log = (folder / "log").string();
    pid = fork();
    if (pid != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(126);
    execl(program, program, scene.c_str(), "--out", out.c_str(), "--domain", number.c_str(), flag, nullptr);
    _exit(127);
  }
  static bool until(auto&& done) {
    for (int i = 0; i < 10'000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }
  bool says(const std::string& words) const {
    return until([&] {
      std::ifstream file(folder / "log");
      return std::string(std::istreambuf_iterator<char>(file), {}).find(words) != std::string::npos;
    });
  }
  /// Its handler of SIGTERM is there.
  bool hears_signals() const {
    return until([&] {
      std::ifstream status("/proc/" + std::to_string(pid) + "/status");
      for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigCgt:"))
          return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1u) != 0;
      return false;
    });
  }
  /// How it ended, as waitpid tells; -1: not at all.
  int end_by(int signal) {
    kill(pid, signal);
    int status = -1;
    if (!until([&] { return waitpid(pid, &status, WNOHANG) == pid; })) return -1;
    pid = -1;
    return status;
  }
  void every_signal(const std::vector<int>& signals, auto&& ready, auto&& afterwards) {
    for (const int signal : signals) {
      ready();
      if (HasFailure()) return;
      for (const int ignored : {SIGPIPE, SIGXFSZ, SIGTTOU}) kill(pid, ignored);
      const int status = end_by(signal);
      const bool in_order = signal == SIGHUP || signal == SIGTERM || signal == SIGINT || signal == SIGPWR;
      if (in_order)
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << signal << ": " << status;
      else
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal << ": " << status;
      afterwards(in_order);
    }
  }

  fs::path folder = fs::temp_directory_path() / ("palpate_signals_" + std::to_string(getpid()));
  pid_t pid = -1;
};

TEST_F(NodeSignals, PhysicsEndsAndItsRecordCanBeRead) {
  const auto record = folder / "out" / "record.h5";
  every_signal(
      {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP, SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU,
       SIGVTALRM, SIGPROF, SIGHUP, SIGPWR, SIGTERM, SIGKILL},
      [&] {
        fs::remove_all(folder / "out");
        fs::create_directories(folder / "out");
        start(PALPATE_PHYSICS);
        ASSERT_TRUE(says("loaded in"));
        ASSERT_TRUE(until([&] { return fs::exists(record) && fs::file_size(record) > 0; }));
      },
      [&](bool in_order) {
        const std::string command = std::string("timeout 60 '" PALPATE "' info '") + record.string() +
                                    "' >'" + (folder / "info").string() + "' 2>&1";
        const int code = std::system(command.c_str());
        std::ifstream file(folder / "info");
        const std::string text(std::istreambuf_iterator<char>(file), {});
        EXPECT_TRUE(WIFEXITED(code) && WEXITSTATUS(code) <= (in_order ? 0 : 2)) << text;
        EXPECT_FALSE(text.empty());
      });
}

TEST_F(NodeSignals, RenderEnds) {
  every_signal(
      {SIGSEGV, SIGABRT, SIGQUIT, SIGUSR1, SIGALRM, SIGXCPU, SIGHUP, SIGPWR, SIGTERM},
      [&] {
        start(PALPATE_RENDER, "--headless");
        ASSERT_TRUE(hears_signals());
        std::this_thread::sleep_for(200ms);  // it opens its picture and the wire
      },
      [](bool) {});
}

}  // namespace
}  // namespace palpate
