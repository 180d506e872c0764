#include "physics_node/contact/hand_play.h"

#include <algorithm>
#include <cmath>

#include "common/message/vec3.h"
#include "physics_node/contact/low_pass.h"

namespace palpate::physics {
namespace {

constexpr double corner_Hz = 100;  // of the velocity, as in the hand

}  // namespace

std::uint32_t new_samples(const ToolState& state, std::uint64_t played) noexcept {
  if (played == 0 || state.sample <= played) return 0;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>({state.n_before, max_told_samples, state.sample - played - 1}));
}

HandPlay::HandPlay(double period) noexcept : period_(period), share_(low_pass_part(corner_Hz, period)) {}

void HandPlay::add(const Vec3& x, std::uint64_t number) noexcept {
  const Moment& before = path_[n_ - 1];
  const double time = period_ * static_cast<double>(number - last_);
  path_[n_] = {x, before.v + share_ * ((x - before.x) / time - before.v)};
  if (n_ == 1) first_ = number;
  ++n_;
  last_ = number;
}

bool HandPlay::take(const ToolState* state, double dt) noexcept {
  path_[0] = path_[n_ - 1];
  n_ = 1;
  begin_ = last_;
  turned_[0] = turned_[1];
  if (state == nullptr || state->sample == last_ || state->sample == 0) {
    stood_ += dt;
    if (stood_ > may_be_late * period_) path_[0].v.setZero();
    return true;
  }
  stood_ = 0;
  const Vec3 newest = vec(state->p_WT);
  turned_[1] = Eigen::Quaterniond(state->q_WT[0], state->q_WT[1], state->q_WT[2], state->q_WT[3]);
  const bool as_before = goes_on(*state);
  stamp_ns_ = state->stamp_ns;
  if (!as_before) {
    path_[0] = {newest, Vec3::Zero()};
    turned_[0] = turned_[1];
    begin_ = last_ = state->sample;
    return false;
  }
  for (std::uint64_t back = new_samples(*state, last_); back > 0; --back) {
    const Array3f& from = state->before[back - 1];
    add(newest + Vec3(from[0], from[1], from[2]), state->sample - back);
  }
  add(newest, state->sample);
  return true;
}

bool HandPlay::goes_on(const ToolState& state) const noexcept {
  if (!seen() || state.sample <= last_) return false;
  const double by_number = period_ * static_cast<double>(state.sample - last_);
  const double by_stamp = 1e-9 * (static_cast<double>(state.stamp_ns) - static_cast<double>(stamp_ns_));
  return std::abs(by_stamp - by_number) < may_differ;
}

HandPlay::Moment HandPlay::at(double share) const noexcept {
  if (n_ == 1) return path_[0];
  const double gap = static_cast<double>(first_ - begin_);
  const double from_begin = std::clamp(share, 0.0, 1.0) * static_cast<double>(last_ - begin_);
  // In intervals of the path, of which the first may be of many samples.
  const double place = from_begin < gap ? from_begin / gap : 1 + from_begin - gap;
  const std::size_t n = std::min(static_cast<std::size_t>(place), n_ - 2);
  const double part = place - static_cast<double>(n);
  const Moment &a = path_[n], &b = path_[n + 1];
  return {a.x + part * (b.x - a.x), a.v + part * (b.v - a.v)};
}

}  // namespace palpate::physics
