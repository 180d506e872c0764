#include "render_node/model/history.h"

#include <algorithm>
#include <cmath>

#include "common/message/messages.h"

namespace palpate::render {

void History::add(double t, double value) {
  if (!(std::abs(t) <= longest_time) || !std::isfinite(value)) return;
  if (t < newest_t_ - slack_s)
    buckets_.clear();
  else
    t = std::max(t, newest_t_);
  newest_t_ = t;
  now_ = value;
  const auto number = static_cast<std::int64_t>(std::floor(t / bucket_s + 1e-6));  // 0.07 / 0.01 is below 7
  if (!buckets_.empty() && buckets_.back().number == number) {
    if (std::abs(value) > std::abs(buckets_.back().value)) buckets_.back().value = value;
  } else {
    buckets_.push_back({number, value});
  }
  const auto oldest = number - std::llround(span_s / bucket_s);
  while (buckets_.front().number < oldest) buckets_.pop_front();
}

std::vector<History::Point> History::points(double now) const {
  std::vector<Point> points;
  points.reserve(buckets_.size());
  const double last = std::floor(now / bucket_s + 1e-6);
  for (const auto& bucket : buckets_) {
    const double age = std::max(0.0, (last - static_cast<double>(bucket.number)) * bucket_s);
    if (age <= span_s + 1e-9) points.push_back({age, bucket.value});
  }
  return points;
}

double History::peak() const noexcept {
  double peak = 0;
  for (const auto& bucket : buckets_) peak = std::max(peak, std::abs(bucket.value));
  return peak;
}

}  // namespace palpate::render
