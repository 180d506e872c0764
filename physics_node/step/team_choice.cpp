#include "physics_node/step/team_choice.h"

#include <algorithm>

namespace palpate::physics {

double TeamChoice::mean_threads() const noexcept {
  return steps_ > 0 ? static_cast<double>(thread_steps_) / static_cast<double>(steps_) : 1;
}

void TeamChoice::took(std::int64_t ns) noexcept {
  ++steps_;
  thread_steps_ += threads();
  if (most_ < 2 || !may_try_) return;
  if (in_trial()) {
    try_on(ns);
  } else {
    settle(ns);
  }
}

void TeamChoice::settle(std::int64_t ns) noexcept {
  since_trial_ns_ += ns;
  window_.add(ns);
  std::int64_t due = interval_ns_;
  if (window_.ns >= shortest_ns) {
    const double mean = window_.mean_ns();
    if (usual_ns_ == 0) usual_ns_ = mean;
    if (mean > another_machine * usual_ns_ || usual_ns_ > another_machine * mean) due = soon();
    if (mean > quite_another * usual_ns_) due = 0;
    window_ = {};
  }
  if (since_trial_ns_ >= due) begin_trial();
}

std::int64_t TeamChoice::soon() const noexcept { return std::max(shortest_ns, interval_ns_ / 4); }

void TeamChoice::begin_trial() noexcept {
  if (settled_ == 1) up_ = true;
  if (settled_ == most_) up_ = false;
  rival_ = up_ ? std::min(2 * settled_, most_) : (settled_ + 1) / 2;
  turn_ = own_ = other_ = {};
  won_ = lost_ = 0;
  turn_number_ = 1;  // of the present number: it is what the rival is measured by
  ++trials_;
}

bool TeamChoice::rival_better(const Stretch& rival, const Stretch& own) const noexcept {
  return rival_ > settled_ ? rival.mean_ns() < worth_more * own.mean_ns()
                           : worth_less * rival.mean_ns() < own.mean_ns();
}

void TeamChoice::try_on(std::int64_t ns) noexcept {
  turn_.add(ns);
  const bool rival = rival_turn();
  if (rival && static_cast<double>(turn_.ns) >
                   surrender * last_.mean_ns() * static_cast<double>(std::max(turn_.steps, last_.steps))) {
    end_trial(false);
    return;
  }
  if (!turn_.whole()) return;
  (rival ? other_ : own_).add(turn_);
  if (rival) ++(rival_better(turn_, last_) ? won_ : lost_);
  last_ = turn_;
  turn_ = {};
  ++turn_number_;
  if (won_ == pairs_to_win || lost_ == pairs_to_win)
    end_trial(won_ == pairs_to_win && rival_better(other_, own_));
}

void TeamChoice::end_trial(bool rival_wins) noexcept {
  if (rival_wins) {
    settled_ = rival_;
    interval_ns_ = soon();
    ++changes_;
  } else {
    interval_ns_ = std::clamp(2 * interval_ns_, shortest_ns, longest_ns);
    up_ = !up_;
  }
  turn_number_ = 0;
  window_ = {};
  usual_ns_ = 0;
  since_trial_ns_ = 0;
}

}  // namespace palpate::physics
