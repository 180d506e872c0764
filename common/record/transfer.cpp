#include <algorithm>
#include <cmath>

#include "common/record/volume.h"

namespace palpate {

bool looks_like_ct(double lo, double hi) { return lo <= -500 && lo >= -32768 && hi >= 100; }

std::vector<TransferPoint> ct_transfer() {
  return {{-1000, {0.00, 0.00, 0.00, 0.0}},  // air
          {-400, {0.90, 0.72, 0.60, 0.0}},   // clear up to here
          {-250, {0.92, 0.75, 0.63, 1.0}},   // skin: the partly filled cells at the surface
          {-90, {0.93, 0.79, 0.62, 1.0}},    // fat
          {0, {0.90, 0.70, 0.58, 1.0}},      // water, brain
          {55, {0.84, 0.56, 0.46, 1.0}},     // muscle
          {226, {0.90, 0.82, 0.70, 1.0}},    // spongy bone
          {700, {0.96, 0.94, 0.88, 1.0}},    // dense bone
          {2000, {1.00, 1.00, 1.00, 1.0}}};  // enamel, metal
}

std::vector<TransferPoint> grey_transfer(double lo, double hi) {
  return {{lo, {0, 0, 0, 0}}, {std::max(hi, lo + 1), {1, 1, 1, 1}}};
}

std::vector<TransferPoint> default_transfer(double lo, double hi) {
  return looks_like_ct(lo, hi) ? ct_transfer() : grey_transfer(lo, hi);
}

std::uint32_t rgba_of(const std::vector<TransferPoint>& transfer, double intensity) {
  if (transfer.empty()) return 0;
  const auto after = std::find_if(transfer.begin(), transfer.end(),
                                  [&](const TransferPoint& point) { return point.intensity > intensity; });
  const auto& b = after == transfer.end() ? transfer.back() : *after;
  const auto& a = after == transfer.begin() ? b : *(after - 1);
  const double span = b.intensity - a.intensity;
  const double t = span > 0 ? std::clamp((intensity - a.intensity) / span, 0.0, 1.0) : 0.0;
  std::uint32_t colour = 0;
  for (unsigned channel = 0; channel < 4; ++channel) {
    const double value = std::clamp(a.rgba[channel] + t * (b.rgba[channel] - a.rgba[channel]), 0.0, 1.0);
    colour |= static_cast<std::uint32_t>(std::lround(255 * value)) << (8 * channel);
  }
  return colour;
}

}  // namespace palpate
