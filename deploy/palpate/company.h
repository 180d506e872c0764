#pragma once
// The other PCs of a session, as one supervisor sees them: whether they fit, and who comes and goes.

#include <chrono>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/wire/companions.h"

namespace palpate::deploy {

class Company {
 public:
  /// @param here  nodes that this PC brings
  Company(Participant& participant, std::vector<NodeKind> here, std::vector<NodeKind> elsewhere);

  /// Before our nodes start: waits until discovery has had its time.
  /// @throws InputError that says who is there and does not fit
  void require_fitting();

  /// Later, now and then: lines to show, once each, about nodes elsewhere that came or went.
  std::vector<std::string> news();

  /// Nodes expected elsewhere that news() saw last to be there.
  bool has(NodeKind node) const;

  /// What does not fit and has stayed for longer than a newcomer takes to leave by itself; empty: nothing.
  std::vector<std::string> quarrel();

 private:
  std::vector<std::string> misfits(bool ours_run) const;

  Companions companions_;
  Identity own_;
  std::vector<NodeKind> here_;
  std::vector<NodeKind> elsewhere_;
  std::vector<Identity> nodes_known_;
  bool ours_run_ = false;
  std::chrono::steady_clock::time_point fits_since_ = std::chrono::steady_clock::now();
};

}  // namespace palpate::deploy
