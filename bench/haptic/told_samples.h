#pragma once
// What the hand sends of its motion: its newest samples, oldest first. Lost messages then lose nothing.

#include <memory>
#include <vector>

#include "haptic_node/tissue/motion_history.h"

namespace palpate::bench {

template <class Sample>
struct ToldSamples {
  std::uint64_t newest = 0;
  std::vector<Sample> samples;
};
using HandSamples = ToldSamples<haptic::HandSample>;
using TipSamples = ToldSamples<haptic::TipSample>;

template <class Sample>
std::shared_ptr<const ToldSamples<Sample>> newest_samples(const haptic::History<Sample>& history) {
  constexpr std::uint64_t most = haptic::History<Sample>::told;
  auto told = std::make_shared<ToldSamples<Sample>>();
  told->newest = history.newest();
  for (std::uint64_t n = told->newest > most ? told->newest - most + 1 : 1; n <= told->newest; ++n)
    told->samples.push_back(history.at(n));
  return told;
}

}  // namespace palpate::bench
