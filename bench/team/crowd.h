#pragma once
// Processes that use all the time that they get, as compilers do.

#include <sys/types.h>

#include <vector>

namespace palpate::bench {

class Crowd {
 public:
  /// Of the priority of this process. @throws std::runtime_error if no process can be made
  explicit Crowd(int processes);
  ~Crowd();
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

 private:
  void end() noexcept;
  std::vector<pid_t> pids_;
};

}  // namespace palpate::bench
