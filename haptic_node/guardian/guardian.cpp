#include "haptic_node/guardian/guardian.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "common/message/messages.h"
#include "common/report/log.h"

namespace palpate::haptic {
namespace {

constexpr int most_starts = 3;
constexpr int pipe_there = STDERR_FILENO + 1;  // its end of the pipe

std::filesystem::path program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "palpate-guardian";
}

/// A session of its own, so that what is sent to the node's group does not reach it; no other file of ours, or a device
/// would stay open when we are dead.
int spawn(pid_t& pid, int pipe_end, std::vector<std::string> words) {
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, pipe_end, pipe_there);
  posix_spawn_file_actions_addclosefrom_np(&files, pipe_there + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, static_cast<short>(POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK));
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  const int error = posix_spawn(&pid, words.front().c_str(), &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

Guardian::Guardian(std::vector<const RescueWords*> tools) {
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (tools[i] == nullptr) continue;
    const RescueWords& tool = *tools[i];
    words_.push_back({std::to_string(i), tool.driver, tool.file, tool.id, tool.shared ? "shared" : "own",
                      std::to_string(tool.pairs.size())});
    words_.back().insert(words_.back().end(), tool.pairs.begin(), tool.pairs.end());
  }
  start();
}

Guardian::~Guardian() {
  for (std::size_t tool = 0; tool < max_tools; ++tool) off(tool);
  end();
}

void Guardian::start() {
  if (words_.empty() || starts_ == most_starts) return;
  starts_ += 1;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return log_warn("no guardian: {}", std::strerror(errno));
  fcntl(ends[1], F_SETFL, O_NONBLOCK);  // a signal handler writes to it
  std::vector<std::string> words = {program().string(), std::to_string(pipe_there)};
  for (const auto& tool : words_) words.insert(words.end(), tool.begin(), tool.end());
  const int error = spawn(pid_, ends[0], std::move(words));
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  end();
  log_warn(
      "no guardian, {} does not start ({}): should this node be killed, only the device's own watchdog is "
      "left",
      program().string(), std::strerror(error));
}

void Guardian::end() noexcept {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

void Guardian::off(std::size_t tool) noexcept {
  const auto number = static_cast<std::uint8_t>(tool);
  if (pipe_ >= 0 && write(pipe_, &number, 1) != 1) return;
}

void Guardian::look_after() {
  if (pid_ <= 0 || waitpid(pid_, nullptr, WNOHANG) != pid_) return;
  pid_ = -1;
  end();
  log_warn("the guardian has gone; {}",
           starts_ < most_starts ? "another one is started" : "there is none now");
  start();
}

}  // namespace palpate::haptic
