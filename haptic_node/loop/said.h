#pragma once
// What was said to a person while the node ran: on the screen at once, and in the summary again.

#include <cstddef>
#include <string>
#include <vector>

#include "common/report/log.h"

namespace palpate::haptic {

class Said {
 public:
  static constexpr std::size_t most = 32;  // lines kept; Why: who has not understood by then does not read on

  void warn(const std::string& line) {
    log_warn("{}", line);
    keep(line);
  }
  void error(const std::string& line) {
    log_error("{}", line);
    keep(line);
  }
  const std::vector<std::string>& lines() const noexcept { return lines_; }

 private:
  void keep(const std::string& line) {
    if (lines_.size() < most) lines_.push_back(line);
  }
  std::vector<std::string> lines_;
};

}  // namespace palpate::haptic
