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
  static constexpr double slack_s = 0.2;

  /// Takes a value at time t [s]; one beyond longest_time is ignored. A time before the newest one by more
  /// than `slack_s` restarts the history (another hand); by less, it counts as the newest: times that arrive
  /// in messages are uneven.
  void add(double t, double value);

  struct Point {
    double age = 0, value = 0;
  };  // age before `now` [s]
  /// Oldest first, not older than the span.
  /// @param now  of the plot, on the clock of add() [s]
  std::vector<Point> points(double now) const;
  std::vector<Point> points() const { return points(newest()); }

  bool empty() const noexcept { return buckets_.empty(); }
  double newest() const noexcept { return newest_t_; }  // time of the newest value [s]
  double now() const noexcept { return now_; }          // newest value
  double peak() const noexcept;                         // largest magnitude over the span

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
