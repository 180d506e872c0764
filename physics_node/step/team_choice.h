#pragma once
// How many threads the next step gets: as many as were measured to be faster. Knows no clock; it hears what steps took.

#include <cstdint>

namespace palpate::physics {

/// Chooses among 1, 2, 4, ... up to `most` threads. Steps with the present number and with its neighbour take turns in a
/// trial; the neighbour wins if it is faster by a margin. Which number is chosen has no effect on any bit of the state.
///
///   trial      up to 5 pairs of stretches, each of 8 ms (Why: a scheduler's slice is 3 ms, and a mean over less is luck)
///              and 16 steps, or of 40 ms. The neighbour must win three pairs, and by the sums. It has lost as soon as it
///              lost three, or took twice the time of the stretch before it
///   margin     more threads must take less than 0.90 of the time, and lose again from 0.96 on
///   interval   of stepping, between trials: 0.25 s at first, twice as long after each that changes nothing, up to 8 s; a
///              quarter of it, not below 0.25 s, after a change and where the mean of 0.25 s differs 1.5 times from what it
///              was after the trial; 0.25 s where it is 4 times that: the machine, or the work, is another one
///
/// Cost: a trial that changes nothing loses 40 ms at most: 2 % of the first 8 s, 0.5 % later.
class TeamChoice {
 public:
  static constexpr std::int64_t stretch_ns = 8'000'000;
  static constexpr std::int64_t stretch_steps = 16;
  static constexpr std::int64_t long_stretch_ns = 40'000'000;
  static constexpr int pairs_to_win = 3;
  static constexpr double surrender = 2;
  static constexpr double worth_more = 0.90, worth_less = 0.96;
  static constexpr std::int64_t shortest_ns = 250'000'000;
  static constexpr std::int64_t longest_ns = 8'000'000'000;
  static constexpr double another_machine = 1.5, quite_another = 4;

  /// As many as are fastest, at most this many.
  static TeamChoice up_to(int most) noexcept { return TeamChoice(most, 1); }
  /// Always this many, without a trial: as a person asked.
  static TeamChoice always(int threads) noexcept { return TeamChoice(threads, threads, false); }

  int most() const noexcept { return most_; }
  /// Of the next step.
  int threads() const noexcept { return rival_turn() ? rival_ : settled_; }
  /// What that step took, wall time [ns].
  void took(std::int64_t ns) noexcept;

  std::int64_t trials() const noexcept { return trials_; }
  std::int64_t changes() const noexcept { return changes_; }
  /// Mean number of threads of a step; 1 before the first.
  double mean_threads() const noexcept;

 private:
  struct Stretch {
    std::int64_t ns = 0, steps = 0;
    void add(std::int64_t more_ns) noexcept { ns += more_ns, ++steps; }
    void add(const Stretch& more) noexcept { ns += more.ns, steps += more.steps; }
    bool whole() const noexcept {
      return ns >= long_stretch_ns || (ns >= stretch_ns && steps >= stretch_steps);
    }
    double mean_ns() const noexcept {
      return steps > 0 ? static_cast<double>(ns) / static_cast<double>(steps) : 0;
    }
  };

  bool in_trial() const noexcept { return turn_number_ > 0; }
  TeamChoice(int most, int first, bool may_try = true) noexcept
      : most_(most), settled_(first), may_try_(may_try) {}
  bool rival_turn() const noexcept { return in_trial() && turn_number_ % 2 == 0; }
  void settle(std::int64_t ns) noexcept;
  std::int64_t soon() const noexcept;
  void begin_trial() noexcept;
  void try_on(std::int64_t ns) noexcept;
  bool rival_better(const Stretch& rival, const Stretch& own) const noexcept;
  void end_trial(bool rival_wins) noexcept;

  int most_;
  int settled_;
  bool may_try_;
  int rival_ = 1;
  bool up_ = true;          // the next rival is the larger neighbour
  int turn_number_ = 0;     // of the trial, from 1; the rival has the even ones. 0: no trial
  int won_ = 0, lost_ = 0;  // pairs, by the rival
  Stretch turn_, last_, own_,
      other_;            // of the trial: this turn and the one before; in all, present number and rival
  Stretch window_;       // between trials
  double usual_ns_ = 0;  // mean of the first window after a trial
  std::int64_t since_trial_ns_ = 0;
  std::int64_t interval_ns_ = stretch_ns;  // the first trial comes at once
  std::int64_t trials_ = 0, changes_ = 0, steps_ = 0, thread_steps_ = 0;
};

}  // namespace palpate::physics
