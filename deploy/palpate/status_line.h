#pragma once
// The line that a person watches while a session runs.

#include <chrono>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "deploy/palpate/status_board.h"

namespace palpate::deploy {

/// A hand that gets energy made out of nothing is named; a hand without forces says why.
/// For example "  12.4 s | physics 1000 Hz x1.00 | haptic 1000 Hz loop 1.2 ms | render 30 Hz | 2 warnings".
std::string status_text(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds);

/// Shows the text on stdout: on a terminal over and over in one line, else a new line every two seconds.
class StatusLine {
 public:
  StatusLine();
  void show(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds);
  void finish();  // ends the line, so that others may print

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  bool open_ = false;
  Clock::time_point next_ = Clock::now();
};

}  // namespace palpate::deploy
