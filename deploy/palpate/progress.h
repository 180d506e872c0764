#pragma once
// How far a simulation is: a bar on a terminal, elsewhere a line now and then.

#include <chrono>
#include <string>

namespace palpate::deploy {

/// The line that a log should show when simulated time has come to t after `wall_s`: none in the first 10 s, then one every
/// 10 s, with the time that is left at this pace. Empty: none.
/// @param said_s  wall time of the last line [s]; moved on when there is one
std::string progress_line(double t, double seconds, double wall_s, double& said_s);

class Progress {
 public:
  /// @param seconds  the whole [s]
  explicit Progress(double seconds);
  /// @param t  reached so far [s]; a terminal's line ends when it reaches the whole
  void show(double t);

 private:
  double seconds_, said_s_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace palpate::deploy
