#pragma once
// Numbers that count what is done to them: an element that runs on them says what it costs. A fused operation counts as two.

namespace palpate::bench {

inline thread_local double counted = 0;

/// A number whose operations count, and that is zero.
struct Counting {
  friend Counting operator+(Counting, Counting) { return one(); }
  friend Counting operator-(Counting, Counting) { return one(); }
  friend Counting operator*(Counting, Counting) { return one(); }
  Counting operator-() const { return {}; }  // part of a fused operation
  Counting& operator+=(Counting) { return counted += 1, *this; }
  friend bool operator>(Counting, Counting) { return true; }

 private:
  static Counting one() { return counted += 1, Counting{}; }
};

struct CountingPack {
  using V = Counting;
  using Number = double;
  static V all(double) noexcept { return {}; }
  static V fma(V, V, V) noexcept { return counted += 2, V{}; }
  static V fnma(V, V, V) noexcept { return counted += 2, V{}; }
  static bool any_above_zero(V) noexcept { return false; }
};

}  // namespace palpate::bench
