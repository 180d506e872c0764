#pragma once
// Patches that break their promises, for a controller that must not mind.

#include <cstddef>
#include <cstdint>
#include <random>

#include "common/message/messages.h"

namespace palpate::bench {

class Rubbish {
 public:
  explicit Rubbish(std::uint64_t seed) : random_(seed) {}
  /// A whole patch that is often nearly right.
  ContactPatch patch();

 private:
  std::uint32_t pick(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double number();
  void spoil(PatchFacet& facet);

  std::mt19937_64 random_;
};

struct RubbishResult {
  std::size_t patches = 0;
  std::uint64_t rejected = 0, taken = 0;
  std::size_t bad_forces = 0;  // ticks in which the force was not finite or above the limit
  double force_most = 0, limit = 0;
};

/// One patch a tick to a production controller whose hand moves in and out of the tissue.
RubbishResult feed_rubbish(std::size_t patches, std::uint64_t seed);

}  // namespace palpate::bench
