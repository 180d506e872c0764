#pragma once
// The last ten seconds of a quantity, thinned to what a plot can show: of every 10 ms the value of largest magnitude.

#include <cstdint>
#include <deque>
#include <vector>

namespace palpate::render {

class History {
 public:
  static constexpr double span_s = 10.0;
  static constexpr double bucket_s = 0.01;

  /// Takes a value at time t [s]; one beyond longest_time is ignored. A time before the newest one starts the history anew (a reset).
  void add(double t, double value);

  struct Point {
    double age = 0, value = 0;
  };  // age before the newest bucket [s]
  /// Oldest first.
  std::vector<Point> points() const;

  bool empty() const noexcept { return buckets_.empty(); }
  double now() const noexcept { return now_; }  // newest value
  double peak() const noexcept;                 // largest magnitude over the span

 private:
  struct Bucket {
    std::int64_t number = 0;
    double value = 0;
  };
  std::deque<Bucket> buckets_;
  double newest_t_ = 0;
  double now_ = 0;
};

}  // namespace palpate::render
