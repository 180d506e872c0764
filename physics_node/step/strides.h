#pragma once
// Bodies that need fewer steps than the world takes: their elements act once for several of its steps, with the
// impulse of them all, and between that their nodes go on as they are.
//
//   v := v + S dt a(x)  in every S-th step,   x := x + dt v  in each
//
// What else acts on them (tools, strands, contact) does so in every step. Where S changes, elements act until the
// next of the new S-th steps: never twice for the same time, nor after it. A body alone is then stepped by leapfrog
// with S dt, which is at most what is stable for it with the strands on it: no vibration of its own meets the
// impulses in step. Energy is read where elements act, so they do in the last step of a frame, and S divides its
// steps.
// Source: the impulse method, Grubmueller et al. 1991; Tuckerman, Berne & Martyna 1992.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpate::physics {

class Strides {
 public:
  /// The next body. @param seconds  for which its elements may act at once; 0: they act in every step
  /// @param cost  of one step of it, in any unit
  void add(double seconds, double cost);
  /// After all are there: finds what number of steps costs least, from n_loaded to a quarter more, when tissue is a
  /// little stiffer than at rest. @param n_loaded  of a frame when all rests; @param frame  its length [s]
  void share(int n_loaded, double frame) noexcept;
  /// The steps of a frame, or of what is left of one, that wants n: n, or up to a quarter more that bodies can share.
  int shared(int n) const noexcept;

  /// n steps of dt come. @param stiffening  of the bodies: see StepOutcome
  void divide(int n, double dt, double stiffening) noexcept;
  /// Until the next divide(): what presses this body wants its answer in every step.
  void act_in_every_step(std::size_t body) noexcept { of_[body].stride = 1; }

  /// For how many steps of dt, from this on, its elements act now; 0: what they have acted for is not over.
  /// @param left  steps after this one; @param each  for this step alone
  int acts_for(std::size_t body, int left, double dt, bool each) noexcept;
  /// Bodies are where they were, and nothing has acted yet.
  void restart() noexcept;
  /// Steps in which its elements have acted, in all.
  std::int64_t acted(std::size_t body) const noexcept { return of_[body].acted; }

 private:
  struct Of {
    double seconds = 0, cost = 1;
    int stride = 1;
    double ahead = 0;  // for which elements have acted beyond where nodes are [s]
    std::int64_t acted = 0;
  };
  static int impulses(const Of& body, int n, double frame) noexcept;

  std::vector<Of> of_;
  int beat_ = 1;
};

}  // namespace palpate::physics
