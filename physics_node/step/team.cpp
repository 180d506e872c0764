#include "physics_node/step/team.h"

#include <algorithm>
#include <chrono>

#include "common/process/silent_thread.h"

namespace palpate::physics {
namespace {

constexpr int pauses_between_looks = 16;  // at the clock

struct Range {
  std::uint32_t call = 0;
  std::uint32_t front = 0, back = 0;  // pieces [front, back)

  explicit Range(std::uint64_t word)
      : call(static_cast<std::uint32_t>(word >> 32)), front((word >> 16) & 0xffff), back(word & 0xffff) {}
  Range(std::uint32_t number, std::size_t count) : call(number), back(static_cast<std::uint32_t>(count)) {}
  std::uint64_t word() const { return std::uint64_t{call} << 32 | std::uint64_t{front} << 16 | back; }
  std::uint32_t take(bool from_front) { return from_front ? front++ : --back; }
};

/// Spins while `value` is `old`, then sleeps until it is not.
void await_change(std::atomic<std::uint32_t>& value, std::uint32_t old, int spin_us) noexcept {
  const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(spin_us);
  do {
    for (int n = 0; n < pauses_between_looks; ++n) {
      if (value.load(std::memory_order_acquire) != old) return;
      __builtin_ia32_pause();
    }
  } while (std::chrono::steady_clock::now() < until);
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Team::Team(int threads) : workers_(static_cast<std::size_t>(std::max(threads, 1) - 1)) {
  for (Worker& worker : workers_) worker.thread = silent_thread([this, &worker] { serve(worker); });
}

Team::~Team() {
  leaving_ = true;
  for (Worker& worker : workers_) {
    worker.rung.fetch_add(1, std::memory_order_release);
    worker.rung.notify_one();
  }
  for (Worker& worker : workers_) worker.thread.join();
}

void Team::claim(bool from_front) noexcept {
  std::uint64_t seen = unclaimed_.load(std::memory_order_acquire);
  for (Range rest(seen); rest.front < rest.back; rest = Range(seen)) {
    const std::uint32_t n = rest.take(from_front);
    if (!unclaimed_.compare_exchange_weak(seen, rest.word(), std::memory_order_acq_rel,
                                          std::memory_order_acquire))
      continue;
    piece_(work_, n);  // both stand until the call is finished, and that needs this piece
    if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1) unfinished_.notify_one();
    seen = unclaimed_.load(std::memory_order_acquire);
  }
}

void Team::serve(Worker& self) noexcept {
  pthread_setname_np(pthread_self(), "palpate-team");
  for (std::uint32_t heard = 0;;) {
    await_change(self.rung, heard, worker_spin_us);
    heard = self.rung.load(std::memory_order_acquire);
    if (leaving_) return;
    claim(false);
  }
}

void Team::run(std::size_t count, int threads, Piece piece, const void* work) noexcept {
  const std::size_t helpers = std::min(workers_.size(), static_cast<std::size_t>(std::max(threads, 1) - 1));
  if (helpers == 0 || count < 2 || count > most_pieces) {
    for (std::size_t n = 0; n < count; ++n) piece(work, n);
    return;
  }
  piece_ = piece;
  work_ = work;
  unfinished_.store(static_cast<std::uint32_t>(count), std::memory_order_relaxed);
  unclaimed_.store(Range(++calls_, count).word(), std::memory_order_release);
  for (std::size_t w = 0; w < std::min(helpers, count - 1); ++w) {
    workers_[w].rung.fetch_add(1, std::memory_order_release);
    workers_[w].rung.notify_one();  // no system call while it spins
  }
  claim(true);
  for (std::uint32_t left; (left = unfinished_.load(std::memory_order_acquire)) > 0;)
    await_change(unfinished_, left, caller_spin_us);
}

}  // namespace palpate::physics
