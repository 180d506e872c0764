#pragma once
// What a led hand feels of a slab that its motion presses, and what the slab bears, by the number of the hand's sample.

#include <cstdint>
#include <map>

#include "bench/haptic/touch_trials.h"

namespace palpate::bench {

/// The real library and controller, pressed by motion.
Case slab_case(const SlabModel& slab, const LinkAge& age);

/// Forces on the hand and on the tool [N].
struct SameSamples {
  std::map<std::uint64_t, Vec3> felt;   // of every sample, before the hold is paid
  std::map<std::uint64_t, Vec3> borne;  // of those that frames end with
  double step = -1, surplus = 0;        // of force beyond K (v T + q) [N]; G [J]

  template <class Each>
  void visit(const Each& each) const {
    for (const auto& [sample, force] : borne)
      if (const auto at = felt.find(sample); at != felt.end()) each(at->second, force);
  }
};

/// When a sample was taken, on the clock of a trial [s].
double time_of(std::uint64_t sample) noexcept;

/// A led hand. @param from, until  what is kept [s]
SameSamples follow(Case c, const Path& path, double from, double until);

}  // namespace palpate::bench
