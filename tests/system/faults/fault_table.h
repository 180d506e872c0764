#pragma once
// What came of many faults, by node and kind.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/message/messages.h"

namespace palpate::test {

enum class FaultKind { killed, ended, away, stopped };
const char* name_of(FaultKind kind);

/// One fault. Times in seconds.
struct FaultResult {
  NodeKind node = NodeKind::physics;
  FaultKind kind = FaultKind::killed;
  bool in_contact = false;  // the hand felt a force when it happened
  std::optional<double>
      to_no_force;  // from the fault; where the hand had lost its source and a force was there to fade
  std::optional<double>
      to_rejoin;    // from the start or SIGCONT; nothing: the next fault came first, by intent
  double rise = 0;  // largest, beyond the hand's own motion [N]
};

class FaultTable {
 public:
  void add(const FaultResult& result) { results_.push_back(result); }
  const std::vector<FaultResult>& results() const { return results_; }
  double longest_to_no_force() const;
  double longest_to_rejoin() const;
  int rejoins(double within_s) const;  // of those that were waited for
  int rejoins() const;
  int in_contact() const;
  std::string text() const;  // as Markdown

 private:
  std::vector<FaultResult> results_;
};

}  // namespace palpate::test
