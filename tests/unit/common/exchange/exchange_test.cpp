#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "common/exchange/spsc_ring.h"
#include "common/exchange/triple_buffer.h"

namespace palpate {
namespace {

/// Large enough that a torn copy would show.
struct Wide {
  std::array<std::uint64_t, 100> words{};
  static Wide all(std::uint64_t value) {
    Wide wide;
    wide.words.fill(value);
    return wide;
  }
  bool is_whole() const {
    for (const auto word : words)
      if (word != words[0]) return false;
    return true;
  }
};

TEST(TripleBuffer, IsEmptyUntilWritten) {
  TripleBuffer<int> buffer;
  EXPECT_EQ(buffer.newest(), nullptr);
  buffer.write(5);
  bool is_new = false;
  ASSERT_NE(buffer.newest(&is_new), nullptr);
  EXPECT_TRUE(is_new);
  EXPECT_EQ(*buffer.newest(&is_new), 5);
  EXPECT_FALSE(is_new);
}

TEST(TripleBuffer, KeepsOnlyTheNewest) {
  TripleBuffer<int> buffer;
  for (int i = 1; i <= 7; ++i) buffer.write(i);
  EXPECT_EQ(*buffer.newest(), 7);
}

TEST(TripleBuffer, NeverShowsAHalfOrAnOlderValueToAnotherThread) {
  constexpr std::uint64_t last = 20'000;
  TripleBuffer<Wide> buffer;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= last; ++i) buffer.write(Wide::all(i));
  });
  std::uint64_t seen = 0;
  bool whole = true, ordered = true;
  while (seen < last) {
    const Wide* value = buffer.newest();
    if (value == nullptr) continue;
    whole = whole && value->is_whole();
    ordered = ordered && value->words[0] >= seen;
    seen = value->words[0];
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(ordered);
}

TEST(SpscRing, RefusesWhenFullAndKeepsTheOrder) {
  SpscRing<int, 4> ring;
  int value = -1;
  EXPECT_FALSE(ring.pop(value));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(4));
  EXPECT_EQ(ring.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
}

TEST(SpscRing, LosesNothingBetweenTwoThreads) {
  constexpr std::uint64_t last = 20'000;
  SpscRing<Wide, 64> ring;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= last;)
      if (ring.push(Wide::all(i))) ++i;
  });
  bool right = true;
  Wide value;
  for (std::uint64_t wanted = 1; wanted <= last;) {
    if (!ring.pop(value)) continue;
    right = right && value.is_whole() && value.words[0] == wanted;
    ++wanted;
  }
  writer.join();
  EXPECT_TRUE(right);
}

}  // namespace
}  // namespace palpate
