#include "bench/stress/batch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>

namespace palpate::bench {
namespace {

constexpr std::uint64_t scenes_per_process = 100;
// Far more than any takes: then it hangs. Of CPU time, for a machine may have others to serve; and of all time where it waits for itself.
constexpr int cpu_seconds_per_scene = 300;
constexpr unsigned seconds_per_scene = 3600;

struct Batch {
  std::uint64_t next = 0, end = 0;  // seeds
  ElementModel model = ElementModel::springs;
  std::filesystem::path file;
};

/// In the child: a line "start SEED" before, a line of results after each scene.
[[noreturn]] void work(const Batch& batch) {
  std::FILE* file = std::fopen(batch.file.c_str(), "w");
  if (file == nullptr) _exit(3);
  for (std::uint64_t seed = batch.next; seed < batch.end; ++seed) {
    const itimerval most{{0, 0}, {cpu_seconds_per_scene, 0}};
    setitimer(ITIMER_PROF, &most, nullptr);
    alarm(seconds_per_scene);
    std::fputs(fmt::format("start {}\n", seed).c_str(), file);
    std::fflush(file);
    try {
      std::fputs(fmt::format("{}\n", fmt::join(words(run_stress(seed, batch.model)), ",")).c_str(), file);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "palpate bench: seed %llu: %s\n", static_cast<unsigned long long>(seed),
                   error.what());
      std::fflush(file);
      _exit(1);
    }
    std::fflush(file);
  }
  std::fclose(file);
  _exit(0);
}

pid_t start(const Batch& batch) {
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(fmt::format("no process can be made: {}", std::strerror(errno)));
  if (pid == 0) work(batch);
  return pid;
}

std::string how(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
    return fmt::format("no answer in {} s of CPU time", cpu_seconds_per_scene);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return fmt::format("no answer in {} s", seconds_per_scene);
  if (WIFSIGNALED(status))
    return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

/// Takes what a process has left. @return the seed that it was at
std::uint64_t collect(const Batch& batch, BatchResults& all) {
  std::uint64_t at = batch.next;
  std::ifstream file(batch.file);
  for (std::string line; std::getline(file, line);) {
    StressResult result;
    if (line.rfind("start ", 0) == 0) {
      at = std::stoull(line.substr(6));
    } else if (parse(line, result)) {
      all.results.push_back(result);
    }
  }
  file.close();
  std::filesystem::remove(batch.file);
  return at;
}

}  // namespace

BatchResults run_batches(std::uint64_t first, std::uint64_t n, ElementModel model, int jobs,
                         const std::filesystem::path& folder,
                         const std::function<void(std::uint64_t)>& done) {
  std::vector<Batch> waiting;
  for (std::uint64_t seed = first; seed < first + n; seed += scenes_per_process)
    waiting.push_back({seed, std::min(seed + scenes_per_process, first + n), model,
                       folder / fmt::format("part_{}.csv", seed)});
  std::reverse(waiting.begin(), waiting.end());
  BatchResults all;
  std::map<pid_t, Batch> running;
  while (!waiting.empty() || !running.empty()) {
    while (!waiting.empty() && static_cast<int>(running.size()) < jobs) {
      const pid_t pid = start(waiting.back());
      running[pid] = waiting.back();
      waiting.pop_back();
    }
    int status = 0;
    const pid_t pid = waitpid(-1, &status, 0);
    const auto ended = running.find(pid);
    if (ended == running.end()) continue;
    Batch batch = ended->second;
    running.erase(ended);
    const std::uint64_t at = collect(batch, all);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      all.crashes.push_back({at, how(status)});
      batch.next = at + 1;
      if (batch.next < batch.end) waiting.push_back(batch);  // go on behind it
    }
    done(all.results.size() + all.crashes.size());
  }
  std::sort(all.results.begin(), all.results.end(),
            [](const auto& a, const auto& b) { return a.seed < b.seed; });
  return all;
}

}  // namespace palpate::bench
