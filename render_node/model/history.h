#pragma once
// The last ten seconds of a force, thinned to what a plot can show: the largest magnitude of every 10 ms.

#include <cstdint>
#include <deque>
#include <vector>

namespace palpate::render {

class ForceHistory {
 public:
  static constexpr double span_s = 10.0;
  static constexpr double bucket_s = 0.01;

  /// Takes a magnitude [N] at time t [s]. A time before the newest one starts the history anew (a reset).
  void add(double t, double newton);

  struct Point {
    double age = 0, newton = 0;
  };  // age before the newest bucket [s]
  /// Oldest first.
  std::vector<Point> points() const;

  bool empty() const noexcept { return buckets_.empty(); }
  double now() const noexcept { return now_; }  // newest magnitude [N]
  double peak() const noexcept;                 // over the span [N]

 private:
  struct Bucket {
    std::int64_t number = 0;
    double newton = 0;
  };
  std::deque<Bucket> buckets_;
  double newest_t_ = 0;
  double now_ = 0;
};

}  // namespace palpate::render
