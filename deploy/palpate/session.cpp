#include "deploy/palpate/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>

#include "common/error/error.h"
#include "common/process/stop_flag.h"
#include "common/wire/reader.h"
#include "deploy/palpate/company.h"
#include "deploy/palpate/memory_watch.h"
#include "deploy/palpate/nodes.h"
#include "deploy/palpate/status_board.h"
#include "deploy/palpate/status_line.h"
#include "deploy/palpate/stop_nodes.h"

namespace palpate::deploy {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto tick = std::chrono::milliseconds(50);
constexpr double silence_reported_s = 60;  // a large volume may load for long: only say so
constexpr double silence_fatal_s = 300;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Session {
 public:
  explicit Session(const SessionPlan& plan)
      : plan_(plan), participant_(plan.membership), statuses_(participant_) {
    shown_ = plan.nodes;
    shown_.insert(shown_.end(), plan.elsewhere.begin(), plan.elsewhere.end());
    if (!plan.elsewhere.empty() || !plan.membership.reach.local()) {
      company_.emplace(participant_, plan.nodes, plan.elsewhere);
      company_->require_fitting();
    }
    for (const NodeKind node : plan.elsewhere) board_.expect_elsewhere(node);
    for (const NodeKind node : plan.nodes) start(node);
  }

  SessionResult run() {
    while (!over()) {
      listen(tick);
      watch_start();
      meet();
      if (const auto text = memory_.news(); !text.empty()) say(text);
      line_.show(board_, shown_, shown_seconds());
    }
    listen(std::chrono::milliseconds(0));
    if (const auto text = memory_.last_words(); !text.empty()) say(text);
    if (running_since_) result_.wall_s = seconds_since(*running_since_);
    line_.finish();
    result_.interrupted = stop_requested();
    if (plan_.ending) plan_.ending();
    stop_nodes(nodes_, result_.interrupted ? hurried : calm);
    for (RunningNode& node : nodes_) conclude(node);
    return result_;
  }

 private:
  void start(NodeKind node) {
    const auto program = plan_.bin / fmt::format("palpate-{}", name_of(node));
    nodes_.push_back({node, Child(program, plan_.arguments)});
    board_.expect(node, nodes_.back().child.pid());
  }

  void listen(std::chrono::milliseconds at_most) {
    statuses_.wait(at_most);
    for (NodeStatus status; statuses_.take(status);) board_.note(status);
  }

  /// True when the session is to end: a person said so, its time is up, or a node has gone or is past waiting for.
  bool over() {
    if (stop_requested() || quarrelled_) return true;
    if (time_is_up() && !plan_.until_closed) return true;
    if (time_is_up() && !said_up_) {
      said_up_ = true;
      say(fmt::format("the {:.6g} s of the scene are over; close the window or press Ctrl-C to end",
                      plan_.seconds));
    }
    return std::any_of(nodes_.begin(), nodes_.end(),
                       [this](RunningNode& node) { return node.child.ending() || silent_for_good(node); });
  }

  bool time_is_up() const {
    return running_since_ && seconds_since(*running_since_) >= plan_.seconds && simulated_enough();
  }

  bool simulated_enough() const {
    if (!plan_.simulated_too || std::find(shown_.begin(), shown_.end(), NodeKind::physics) == shown_.end())
      return true;
    const auto& physics = board_.at(NodeKind::physics).newest;
    return physics && physics->t >= plan_.seconds;
  }

  void watch_start() {
    if (running_since_) return;
    const bool all = std::all_of(shown_.begin(), shown_.end(),
                                 [this](NodeKind node) { return board_.at(node).running(); });
    if (all) running_since_ = Clock::now();
  }

  /// Across PCs: says who came and went, and ends the session if somebody does not fit and stays.
  void meet() {
    if (!company_) return;
    for (const auto& text : company_->news()) say(text);
    for (const NodeKind node : plan_.elsewhere)
      if (board_.at(node).newest && !company_->has(node))
        board_.expect_elsewhere(node);  // what it said is old
    const auto lines = company_->quarrel();
    for (const auto& text : lines) say(text);
    quarrelled_ = !lines.empty();
    if (quarrelled_) result_.exit_code = exit_mistake;
  }

  void say(const std::string& text) {
    line_.finish();
    std::fprintf(stderr, "palpate: %s\n", text.c_str());
  }

  bool silent_for_good(const RunningNode& node) {
    if (board_.at(node.node).newest) return false;
    const double silent_s = seconds_since(started_);
    if (silent_s > silence_reported_s && !silence_reported_) {
      silence_reported_ = true;
      say(fmt::format("{} has said nothing for {:.0f} s; still waiting (Ctrl-C ends)", name_of(node.node),
                      silent_s));
    }
    return silent_s > silence_fatal_s;
  }

  double shown_seconds() const {
    const auto& physics = board_.at(NodeKind::physics).newest;
    if (physics) return physics->t;
    return running_since_ ? seconds_since(*running_since_) : 0;
  }

  /// A person has closed the window before the session had begun, which ends all nodes.
  bool window_closed() {
    return std::any_of(nodes_.begin(), nodes_.end(), [](RunningNode& node) {
      return node.node == NodeKind::render && !node.told && node.child.ending() && node.child.wait().clean();
    });
  }

  /// After all have gone: what became of one node, and what that means for the session.
  void conclude(RunningNode& node) {
    const StatusBoard::Entry& entry = board_.at(node.node);
    const Ending ending = node.child.wait();
    const bool asked = node.told && !node.killed;
    result_.nodes.push_back({.node = node.node,
                             .seen = entry.newest.has_value(),
                             .ending = ending,
                             .killed = node.killed,
                             .mean_rate_Hz = entry.mean_rate_Hz(),
                             .mean_real_time_factor = entry.mean_real_time_factor()});
    const std::string name(name_of(node.node));
    if (ending.clean() && (asked || running_since_ || result_.interrupted || window_closed())) {
      if (!asked && !result_.interrupted && node.node != NodeKind::render)
        say(fmt::format("{} was ended from outside, and the session with it", name));
      return;
    }
    // Why: a node that gets SIGTERM before it has installed its handler is ended by it, as asked.
    if (asked && ending.by_signal && ending.code == SIGTERM && !entry.newest) return;
    if (node.killed) {
      std::fprintf(stderr, "palpate: %s did not end when it was told to, and was killed\n", name.c_str());
    } else if (ending.clean()) {
      std::fprintf(stderr, "palpate: %s ended before the session had begun\n", name.c_str());
    } else {
      std::fprintf(stderr, "palpate: %s %s\n", name.c_str(), ending.text().c_str());
    }
    const bool mistake = !ending.by_signal && ending.code == exit_mistake;
    result_.exit_code = std::max(result_.exit_code, mistake ? exit_mistake : exit_failed);
  }

  const SessionPlan& plan_;
  std::vector<RunningNode> nodes_;
  Participant participant_;
  Reader<NodeStatus> statuses_;
  StatusBoard board_;
  std::optional<Company> company_;  // across PCs only
  MemoryWatch memory_{plan_.membership.reach.local()};
  std::vector<NodeKind> shown_;  // ours, then those elsewhere
  bool quarrelled_ = false;
  StatusLine line_;
  Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> running_since_;
  bool silence_reported_ = false;
  bool said_up_ = false;
  SessionResult result_;
};

}  // namespace

SessionResult run_session(const SessionPlan& plan) { return Session(plan).run(); }

}  // namespace palpate::deploy
