#pragma once
// What the hand sends of its motion: its newest samples, oldest first. Lost messages then lose nothing.

#include <memory>
#include <type_traits>
#include <vector>

#include "haptic_node/tissue/motion_history.h"

namespace palpate::bench {

/// Along z, down: as tissue in one dimension has it.
struct HandSample {
  double x = 0;  // depth [m]
  double v = 0;  // smoothed [m/s]
};
inline HandSample straight(const haptic::TipSample& tip) noexcept { return {-tip.x.z(), -tip.v.z()}; }

template <class Sample>
struct ToldSamples {
  std::uint64_t newest = 0;
  std::vector<Sample> samples;
};
using HandSamples = ToldSamples<HandSample>;
using TipSamples = ToldSamples<haptic::TipSample>;

/// @param as  makes one of a TipSample
template <class As>
auto newest_samples(const haptic::TipHistory& history, const As& as) {
  using Sample = std::remove_cvref_t<decltype(as(history.at(0)))>;
  constexpr std::uint64_t most = haptic::TipHistory::told;
  auto told = std::make_shared<ToldSamples<Sample>>();
  told->newest = history.newest();
  for (std::uint64_t n = told->newest > most ? told->newest - most + 1 : 1; n <= told->newest; ++n)
    told->samples.push_back(as(history.at(n)));
  return std::shared_ptr<const ToldSamples<Sample>>(told);
}

}  // namespace palpate::bench
