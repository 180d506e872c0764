#pragma once
// The line that a person watches while a session runs.

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "deploy/palpate/status_board.h"

namespace palpate::deploy {

/// A hand whose loop has generated energy is named; a hand without forces says why. For example "  12.4 s |
/// physics 1000 Hz x1.00 | haptic 1000 Hz loop 1.2 ms | render 30 Hz". Warnings follow in words.
std::string status_text(const StatusBoard& board, const std::vector<NodeKind>& nodes, double seconds);

/// At most so many columns, the last of them dots where it was longer; 0: any.
std::string cut_to(const std::string& line, std::size_t columns);

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
