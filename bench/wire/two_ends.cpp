#include "bench/wire/two_ends.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <thread>

namespace palpate::bench {
namespace {

/// In a child: `work`, and out without what the parent would do at its end.
template <class Work>
[[noreturn]] void become(Path path, const Work& work) {
  if (path == Path::udp) setenv("PALPATE_SHARED_MEMORY", "off", 1);
  int code = 0;
  try {
    work();
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate bench: wire: {}\n", error.what());
    code = 1;
  }
  std::exit(code);  // not _exit: iceoryx tells RouDi on the way out
}

void end_within(pid_t child, std::chrono::milliseconds allowed) {
  const auto end = std::chrono::steady_clock::now() + allowed;
  while (waitpid(child, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

Membership bench_membership() {
  Membership membership;
  membership.domain = bench_domain;
  membership.shared_memory = true;
  return membership;
}

std::vector<double> run_ends(Path path, const std::function<std::vector<double>()>& first,
                             const std::function<void()>& second) {
  int answer[2] = {};
  if (pipe(answer) != 0) return {};
  std::fflush(nullptr);
  const pid_t one = fork();
  if (one == 0) {
    become(path, [&] {
      const auto values = first();
      const std::size_t size = values.size() * sizeof(double);
      if (write(answer[1], values.data(), size) != static_cast<ssize_t>(size)) _exit(1);
    });
  }
  const pid_t other = fork();
  if (other == 0) become(path, second);
  close(answer[1]);
  std::vector<double> values;
  for (double value = 0; read(answer[0], &value, sizeof value) == sizeof value;) values.push_back(value);
  close(answer[0]);
  int status = 0;
  waitpid(one, &status, 0);
  end_within(other, std::chrono::seconds(10));
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? values : std::vector<double>{};
}

double cpu_s() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace palpate::bench
