// palpate-guardian: waits for palpate-haptic to die, and switches off the motors that it has left on. Started by it.
//   palpate-guardian PIPE { TOOL DRIVER FILE ID N WORD... }...      N words: key, value, key, value, ...

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
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
constexpr unsigned hanging_s = 10;  // a vendor's library that takes longer is ended

struct Tool {
  std::size_t number;
  haptic::DriverLibrary driver;
  std::string id;
  std::vector<const char*> pairs;
  bool off = false;
};

/// What ends others must not end the guardian: only the end of the node does.
void be_steadfast() {
  for (int signal = 1; signal <= SIGRTMAX; ++signal)
    if (signal != SIGSEGV && signal != SIGBUS && signal != SIGILL && signal != SIGFPE && signal != SIGABRT &&
        signal != SIGCHLD)
      std::signal(signal, SIG_IGN);
  mlockall(MCL_CURRENT);  // both help where they are allowed
  sched_param priority{};
  priority.sched_priority = 70;
  sched_setscheduler(0, SCHED_FIFO, &priority);
}

/// Drivers are loaded now; what a vendor has to be loaded for, only when it is needed.
std::vector<Tool> tools_of(int argc, char** argv) {
  std::vector<Tool> tools;
  for (int i = 2; i + 5 <= argc;) {
    const int n = std::atoi(argv[i + 4]);
    if (n < 0 || n > argc - (i + 5)) break;
    Tool tool{std::strtoul(argv[i], nullptr, 10),
              haptic::DriverLibrary::load_file(argv[i + 1], argv[i + 2]),
              argv[i + 3],
              {}};
    tool.pairs.assign(argv + i + 5, argv + i + 5 + n);
    tools.push_back(std::move(tool));
    i += 5 + n;
  }
  return tools;
}

/// Until the node has gone.
void listen(int pipe, std::vector<Tool>& tools) {
  unsigned char number = 0;
  for (;;) {
    const ssize_t n = read(pipe, &number, 1);
    if (n == 0) return;
    if (n < 0 && errno != EINTR) return;
    for (Tool& tool : tools)
      if (n == 1 && tool.number == number) tool.off = true;
  }
}

void log_line(void*, int, const char* line) { std::fprintf(stderr, "palpate-guardian: %s\n", line); }

/// Again and again: the system may still be taking the device from the dead.
void rescue(const Tool& tool, std::int64_t since_ns) {
  std::signal(SIGALRM, SIG_DFL);
  alarm(hanging_s);
  const hdev_host host = {sizeof(hdev_host), 0, nullptr, log_line, [](void*) { return now_ns(); }};
  const auto n_pairs = static_cast<std::uint32_t>(tool.pairs.size() / 2);
  const hdev_api& api = tool.driver.api();
  while (api.rescue(&host, tool.id.c_str(), tool.pairs.data(), n_pairs) != HDEV_OK) {
    if (now_ns() - since_ns > patience_ns) {
      std::fprintf(
          stderr,
          "palpate-guardian: palpate-haptic has died, and the motors of \"%s\"%s%s may be on: %s; switch the "
          "device off\n",
          tool.driver.name().c_str(), tool.id.empty() ? "" : " ", tool.id.c_str(), api.last_error(nullptr));
      return;
    }
    std::this_thread::sleep_for(2ms);
  }
  std::fprintf(
      stderr,
      "palpate-guardian: palpate-haptic has died; the motors of \"%s\"%s%s are off, %.1f ms after that\n",
      tool.driver.name().c_str(), tool.id.empty() ? "" : " ", tool.id.c_str(),
      1e-6 * static_cast<double>(now_ns() - since_ns));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "palpate-guardian is started by palpate-haptic\n");
    return exit_mistake;
  }
  try {
    be_steadfast();
    std::vector<Tool> tools = tools_of(argc, argv);
    listen(std::atoi(argv[1]), tools);
    const std::int64_t since_ns = now_ns();
    std::erase_if(tools, [](const Tool& tool) { return tool.off || tool.driver.api().rescue == nullptr; });
    // A process each: no library waits for another, or takes it along.
    while (tools.size() > 1 && fork() > 0) tools.pop_back();
    if (!tools.empty()) rescue(tools.back(), since_ns);
    return exit_ok;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate-guardian: %s\n", error.what());
    return exit_failed;
  }
}
