// A race on purpose: the sanitizer must name it and turn the exit code. Without it, a build that watches nothing would pass.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

namespace palpate::test {
namespace {

constexpr int code_of_thread_sanitizer = 66;  // its default

/// Two threads that count together; each counts much, so that they meet.
template <class Number>
[[noreturn]] void count_in_two_threads() {
  static Number count{};
  const auto add = [] {
    for (int n = 0; n < 100'000; ++n) ++count;
  };
  std::thread other(add);
  add();
  other.join();
  std::exit(0);
}

TEST(ThreadSanitizer, SeesARace) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(count_in_two_threads<int>(), testing::ExitedWithCode(code_of_thread_sanitizer), "data race");
}

TEST(ThreadSanitizer, SeesNoneBetweenAtomics) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(count_in_two_threads<std::atomic<int>>(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpate::test
