#pragma once
// Patches and wrenches that break their promises, for a controller that must not mind.

#include <cstddef>
#include <cstdint>
#include <random>

#include "common/message/messages.h"
#include "common/scene/kinds.h"

namespace palpate::bench {

class Rubbish {
 public:
  explicit Rubbish(std::uint64_t seed) : random_(seed) {}
  /// A whole patch that is often nearly right. Its stamps are of any time, its tick of the past or the future.
  ContactPatch patch();
  /// A wrench likewise.
  ToolWrench wrench();

 private:
  std::uint32_t pick(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double number();
  std::int64_t stamp();
  void spoil(PatchFacet& facet);

  std::mt19937_64 random_;
};

struct RubbishResult {
  std::size_t fed = 0;
  std::uint64_t rejected = 0, taken = 0;
  std::uint64_t wrongly_taken = 0;  // of another tool, or older than one that came less than 0.12 s before
  std::size_t bad_forces = 0;       // ticks in which force or torque was not finite or above its limit
  double force_most = 0, limit = 0;
};

/// One patch and one wrench a tick to a production controller whose hand moves in and out of the tissue. Of the one that its
/// model looks at: norton patches, tangent wrenches.
RubbishResult feed_rubbish(std::size_t ticks, ForceModel model, std::uint64_t seed);

}  // namespace palpate::bench
