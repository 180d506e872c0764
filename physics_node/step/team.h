#pragma once
// Threads that share the chunks of a step, and cost nothing while there is none.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace palpate::physics {

/// The caller and its workers. A piece of work belongs to whoever claims it first: a worker whose core is taken by another
/// process claims nothing, and the caller does its share. So a call waits for pieces that were begun, never for a thread
/// that has not come. (An OpenMP team waits for all its threads at every barrier: beside two compilers on two cores a step
/// then takes 30 to 50 times as long as on one thread.)
///
/// A worker spins for `worker_spin_us` after its last piece, since the next step is near, then it sleeps. The caller waits
/// for begun pieces in the same way, so that what keeps the worker from its core gets the caller's, or the worker does.
/// Cost of a call (palpate bench team): below 1 us while the workers spin, 4 us where one has to be woken.
class Team {
 public:
  static constexpr std::size_t most_pieces = 0xffff;
  static constexpr int worker_spin_us = 50;  // Why: two steps of a frame lie less than this apart
  static constexpr int caller_spin_us = 50;  // Why: about one chunk of 4096 masses

  /// Makes threads - 1 workers, which inherit the priority of the caller and leave all signals to it.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const noexcept { return static_cast<int>(workers_.size()) + 1; }

  /// Calls work(n) once for every n in [0, count), on at most `threads` threads; has returned from all of them at the end.
  /// The caller begins at the front and the workers at the back, so that each core meets again what it has in its cache.
  /// Contract: one call at a time. Allocates and throws nothing; blocks only for pieces that a worker has begun.
  template <class Work>
  void each(std::size_t count, int threads, const Work& work) noexcept {
    run(
        count, threads, [](const void* self, std::size_t n) { (*static_cast<const Work*>(self))(n); }, &work);
  }

 private:
  using Piece = void (*)(const void* work, std::size_t n);
  struct alignas(64) Worker {
    std::atomic<std::uint32_t> rung{0};  // how often it was called
    std::thread thread;
  };

  void run(std::size_t count, int threads, Piece piece, const void* work) noexcept;
  void claim(bool from_front) noexcept;
  void serve(Worker& self) noexcept;

  // The call's number (32 bits), the first piece that nobody has claimed and the one after the last (16 bits each), in
  // one word: whoever claims a piece knows that it belongs to the call that is going on.
  alignas(64) std::atomic<std::uint64_t> unclaimed_{0};
  alignas(64) std::atomic<std::uint32_t> unfinished_{0};
  Piece piece_ = nullptr;
  const void* work_ = nullptr;
  std::uint32_t calls_ = 0;
  std::atomic<bool> leaving_{false};
  std::vector<Worker> workers_;
};

}  // namespace palpate::physics
