#pragma once
// `palpate run` with fake nodes, in a folder and a DDS domain of its own.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/report/json_file.h"
#include "tests/system/dds_domain.h"
#include "tests/system/patience.h"

namespace palpate::test {

class SupervisedRun {
 public:
  SupervisedRun() {
    namespace fs = std::filesystem;
    fs::remove_all(folder);
    fs::create_directories(folder / "bin");
    for (const char* node : {"physics", "haptic", "render"}) {
      fs::create_symlink(FAKE_NODE, folder / "bin" / ("palpate-" + std::string(node)));
    }
    std::ofstream(folder / "scene.toml") << scene_text();
  }
  ~SupervisedRun() {
    if (pid > 0) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
    std::filesystem::remove_all(folder);
  }

  /// @param whims  environment of the fake nodes, for example {"FAKE_PHYSICS", "crash"}
  void start(const std::vector<std::string>& extra = {},
             const std::map<std::string, std::string>& whims = {}) {
    std::vector<std::string> words = {PALPATE,
                                      "run",
                                      (folder / "scene.toml").string(),
                                      "--out",
                                      out().string(),
                                      "--bin-dir",
                                      (folder / "bin").string(),
                                      "--domain",
                                      std::to_string(domain)};
    if (headless) words.emplace_back("--headless");
    words.insert(words.end(), extra.begin(), extra.end());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out_file = (folder / "stdout").string();
    const std::string err_file = (folder / "stderr").string();
    for (const auto& file : {out_file, err_file}) std::filesystem::remove(file);  // of a start before
    pid = fork();
    if (pid != 0) return;
    for (const auto& [name, value] : whims) setenv(name.c_str(), value.c_str(), 1);
    if (std::freopen(out_file.c_str(), "w", stdout) == nullptr ||
        std::freopen(err_file.c_str(), "w", stderr) == nullptr)
      _exit(126);
    execv(PALPATE, argv.data());
    _exit(127);
  }

  /// Exit code, or -1 if a signal ended it or it does not end.
  int wait() {
    const auto end = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (waitpid(pid, &status, WNOHANG) != pid) {
      if (std::chrono::steady_clock::now() > end) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    pid = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string text(const char* stream) const {
    std::ifstream file(folder / stream);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// Waits until the status line says so. @return false if that takes too long
  bool said(const std::string& words) const {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (text("stdout").find(words) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

  /// Process ids of the nodes: the children of the running palpate, by program name.
  std::map<std::string, pid_t> node_pids() const {
    std::map<std::string, pid_t> found;
    std::ifstream children("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children");
    for (pid_t child = 0; children >> child;) {
      std::ifstream line("/proc/" + std::to_string(child) + "/cmdline");
      std::string program;
      std::getline(line, program, '\0');
      found[std::filesystem::path(program).filename().string()] = child;
    }
    return found;
  }

  const std::filesystem::path& out() const { return out_folder; }
  nlohmann::json summary() const { return read_json((out() / "summary.json").string()); }
  static std::string scene_text();

  int domain = own_domain();
  bool headless = true;
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("palpate_run_" + std::to_string(getpid()));
  std::filesystem::path out_folder = folder / "out";
  pid_t pid = -1;
};

}  // namespace palpate::test
