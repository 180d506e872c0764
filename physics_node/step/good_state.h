#pragma once
// Two places for a saved state: the last that is good, and one that is to prove itself.

#include <array>
#include <cstddef>
#include <utility>

namespace palpate::physics {

template <class State>
class GoodState {
 public:
  GoodState() = default;
  GoodState(State a, State b) : of_{std::move(a), std::move(b)} {}

  /// Where the next state goes. @param proved  the one saved last is the good one from now on
  State& next(bool proved) noexcept {
    if (proved) good_ = 1 - good_;
    return of_[1 - good_];
  }
  /// Calls change(state) for both.
  template <class Change>
  void each(const Change& change) noexcept {
    for (State& state : of_) change(state);
  }
  const State& good() const noexcept { return of_[good_]; }

 private:
  std::array<State, 2> of_{};
  std::size_t good_ = 0;
};

}  // namespace palpate::physics
