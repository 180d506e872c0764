#pragma once
// A program that a test starts beside itself and that says one line when it is ready.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace palpate::test {

class HelperProcess {
 public:
  explicit HelperProcess(std::vector<std::string> words) {
    int ends[2];
    if (pipe(ends) != 0) {
      ADD_FAILURE() << "no pipe";
      return;
    }
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    out_ = fdopen(ends[0], "r");
  }
  ~HelperProcess() {
    end(SIGKILL);
    if (out_ != nullptr) std::fclose(out_);
  }
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// The next line that it says, or what has come of it when it has ended.
  std::string line() {
    std::string text;
    for (int letter = std::fgetc(out_); letter != EOF && letter != '\n'; letter = std::fgetc(out_))
      text += static_cast<char>(letter);
    return text;
  }
  /// Waits until it has ended by itself.
  void wait() {
    if (pid_ > 0) waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  void end(int signal) {
    if (pid_ > 0) kill(pid_, signal);
    wait();
  }

 private:
  pid_t pid_ = -1;
  std::FILE* out_ = nullptr;
};

}  // namespace palpate::test
