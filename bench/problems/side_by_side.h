#pragma once
// Many runs that know nothing of each other, some at a time.

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate::bench {

/// Calls run(i) for i in [0, n) from `jobs` threads.
/// @param done  called from one thread at a time with how many are over
inline void side_by_side(std::size_t n, int jobs, const std::function<void(std::size_t)>& run,
                         const std::function<void(std::size_t)>& done = {}) {
  std::atomic<std::size_t> next{0};
  std::size_t over = 0;
  std::mutex saying;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      run(i);
      const std::lock_guard lock(saying);
      ++over;
      if (done) done(over);
    }
  };
  std::vector<std::jthread> team;
  for (int k = 0; k < jobs; ++k) team.emplace_back(work);
}

}  // namespace palpate::bench
