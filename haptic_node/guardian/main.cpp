// palpate-guardian: waits for palpate-haptic to die, and switches off the motors that it has left on. Started by it.
//   palpate-guardian PIPE { TOOL DRIVER FILE ID shared|own N WORD... }...      N words: key, value, key, value, ...

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "common/error/error.h"
#include "common/time/clock.h"
#include "haptic_node/device/driver_library.h"

namespace {

using namespace palpate;
using namespace std::chrono_literals;
constexpr std::int64_t patience_ns =
    3'000'000'000;                  // a device that cannot be opened for so long is left alone
constexpr int look_every_ms = 10;   // whether the node is stopped
constexpr unsigned hanging_s = 10;  // a vendor's library that takes longer is ended

struct Tool {
  std::size_t number;
  haptic::DriverLibrary driver;
  std::string id;
  bool shared;  // can be reached while the node has it
  std::vector<const char*> pairs;
  bool off = false;
};

/// What ends others must not end the guardian: only the end of the node does.
void be_steadfast() {
  for (int signal = 1; signal <= SIGRTMAX; ++signal)
    if (signal != SIGSEGV && signal != SIGBUS && signal != SIGILL && signal != SIGFPE && signal != SIGABRT)
      std::signal(signal, SIG_IGN);
  mlockall(MCL_CURRENT);  // both help where they are allowed
  sched_param priority{};
  priority.sched_priority = 70;
  sched_setscheduler(0, SCHED_FIFO, &priority);
}

/// Drivers are loaded now; what a vendor has to be loaded for, only when it is needed.
std::vector<Tool> tools_of(int argc, char** argv) {
  std::vector<Tool> tools;
  constexpr int head = 6;
  for (int i = 2; i + head <= argc;) {
    const int n = std::atoi(argv[i + 5]);
    if (n < 0 || n > argc - (i + head)) break;
    Tool tool{std::strtoul(argv[i], nullptr, 10),
              haptic::DriverLibrary::load_file(argv[i + 1], argv[i + 2]),
              argv[i + 3],
              std::string(argv[i + 4]) == "shared",
              {}};
    tool.pairs.assign(argv + i + head, argv + i + head + n);
    if (tool.driver.api().rescue != nullptr) tools.push_back(std::move(tool));
    i += head + n;
  }
  return tools;
}

void log_line(void*, int, const char* line) { std::fprintf(stderr, "palpate-guardian: %s\n", line); }

/// Again and again: the system may still be taking the device from the dead.
/// @param node  "palpate-haptic has died"
void rescue(const Tool& tool, const char* node, std::int64_t since_ns) {
  std::signal(SIGALRM, SIG_DFL);
  alarm(hanging_s);
  const hdev_host host = {sizeof(hdev_host), 0, nullptr, log_line, [](void*) { return now_ns(); }};
  const auto n_pairs = static_cast<std::uint32_t>(tool.pairs.size() / 2);
  const hdev_api& api = tool.driver.api();
  const std::string device =
      fmt::format("\"{}\"{}{}", tool.driver.name(), tool.id.empty() ? "" : " ", tool.id);
  while (api.rescue(&host, tool.id.c_str(), tool.pairs.data(), n_pairs) != HDEV_OK) {
    if (now_ns() - since_ns > patience_ns) {
      std::fprintf(stderr,
                   "palpate-guardian: %s, and the motors of %s may be on: %s; switch the device off\n", node,
                   device.c_str(), api.last_error(nullptr));
      return;
    }
    std::this_thread::sleep_for(2ms);
  }
  std::fprintf(stderr, "palpate-guardian: %s; the motors of %s are off, %.1f ms after that\n", node,
               device.c_str(), 1e-6 * static_cast<double>(now_ns() - since_ns));
}

/// A process each: no library waits for another, or takes it along. Nobody waits for these.
void rescue_all(const std::vector<Tool>& tools, const char* node, bool shared_only) {
  const std::int64_t since_ns = now_ns();
  for (const Tool& tool : tools) {
    if (tool.off || (shared_only && !tool.shared) || fork() != 0) continue;
    rescue(tool, node, since_ns);
    std::fflush(stderr);
    _exit(0);
  }
}

/// By a signal or a debugger: its threads stand still, its devices do not.
bool is_stopped(pid_t node) {
  std::ifstream file(fmt::format("/proc/{}/stat", node));
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(") ");
  return name_end != line.npos && (line[name_end + 2] == 'T' || line[name_end + 2] == 't');
}

/// Until the node has gone.
void listen(int pipe, std::vector<Tool>& tools) {
  const pid_t node = getppid();
  const bool look = std::any_of(tools.begin(), tools.end(), [](const Tool& tool) { return tool.shared; });
  bool was_stopped = false;
  for (;;) {
    pollfd wait{pipe, POLLIN, 0};
    if (poll(&wait, 1, look ? look_every_ms : -1) <= 0) {
      const bool stopped = look && is_stopped(node);
      if (stopped && !was_stopped) rescue_all(tools, "palpate-haptic is stopped", true);
      was_stopped = stopped;
      continue;
    }
    unsigned char number = 0;
    const ssize_t n = read(pipe, &number, 1);
    if (n == 0 || (n < 0 && errno != EINTR)) return;
    for (Tool& tool : tools)
      if (n == 1 && tool.number == number) tool.off = true;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "palpate-guardian is started by palpate-haptic\n");
    return exit_mistake;
  }
  try {
    std::vector<Tool> tools = tools_of(argc, argv);
    be_steadfast();
    listen(std::atoi(argv[1]), tools);
    rescue_all(tools, "palpate-haptic has died", false);
    return exit_ok;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate-guardian: %s\n", error.what());
    return exit_failed;
  }
}
