#include "deploy/palpate/child.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace palpate::deploy {
namespace {

constexpr int exec_failed = 127;

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent) noexcept {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(exec_failed);  // we were orphaned before that took effect
  close_range(STDERR_FILENO + 1, ~0U, 0);
  execv(program, arguments);
  _exit(exec_failed);
}

}  // namespace

std::string Ending::text() const {
  if (!by_signal) return fmt::format("ended with exit code {}", code);
  const char* name = sigabbrev_np(code);  // none for real-time signals
  return fmt::format("was ended by signal {} ({}{}{})", code, name == nullptr ? "" : "SIG",
                     name == nullptr ? "" : name + std::string(", "), strsignal(code));
}

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  std::string name = program.string();
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv = {name.data()};
  for (auto& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(name.c_str(), argv.data(), parent);
  if (pid_ < 0) throw std::runtime_error(fmt::format("{} cannot be started: {}", name, std::strerror(errno)));
  setpgid(pid_, pid_);  // also here, so that it is done before we go on
}

Child::Child(Child&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), ending_(std::exchange(other.ending_, std::nullopt)) {}

Child::~Child() {
  if (pid_ < 0 || ending()) return;
  signal(SIGKILL);
  wait();
}

void Child::note(int status) noexcept {
  ending_ = WIFSIGNALED(status) ? Ending{true, WTERMSIG(status)} : Ending{false, WEXITSTATUS(status)};
}

const std::optional<Ending>& Child::ending() noexcept {
  int status = 0;
  if (!ending_ && waitpid(pid_, &status, WNOHANG) == pid_) note(status);
  return ending_;
}

Ending Child::wait() noexcept {
  int status = 0;
  while (!ending_) {
    if (waitpid(pid_, &status, 0) == pid_)
      note(status);
    else if (errno != EINTR)
      ending_ = Ending{false, exec_failed};
  }
  return *ending_;
}

void Child::signal(int number) noexcept {
  if (!ending()) kill(pid_, number);
}

}  // namespace palpate::deploy
