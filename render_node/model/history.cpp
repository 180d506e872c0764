#include "render_node/model/force_history.h"

#include <algorithm>
#include <cmath>

namespace palpate::render {

void ForceHistory::add(double t, double newton) {
  if (!std::isfinite(t) || !std::isfinite(newton)) return;
  if (t < newest_t_) buckets_.clear();
  newest_t_ = t;
  now_ = newton;
  const auto number = static_cast<std::int64_t>(std::floor(t / bucket_s + 1e-6));  // 0.07 / 0.01 is below 7
  if (!buckets_.empty() && buckets_.back().number == number) {
    buckets_.back().newton = std::max(buckets_.back().newton, newton);
  } else {
    buckets_.push_back({number, newton});
  }
  const auto oldest = number - std::llround(span_s / bucket_s);
  while (buckets_.front().number < oldest) buckets_.pop_front();
}

std::vector<ForceHistory::Point> ForceHistory::points() const {
  std::vector<Point> points;
  points.reserve(buckets_.size());
  for (const auto& bucket : buckets_) {
    points.push_back({static_cast<double>(buckets_.back().number - bucket.number) * bucket_s, bucket.newton});
  }
  return points;
}

double ForceHistory::peak() const noexcept {
  double peak = 0;
  for (const auto& bucket : buckets_) peak = std::max(peak, bucket.newton);
  return peak;
}

}  // namespace palpate::render
