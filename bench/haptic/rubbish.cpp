#include "bench/haptic/rubbish.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/haptic/tissue.h"
#include "haptic_node/control/controller.h"

namespace palpate::bench {

double Rubbish::number() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(), inf, -inf, 1e30, -1e-300, 0.0};
  const std::uint32_t kind = pick(9);
  return kind < 6 ? odd[kind] : 0.1 * (static_cast<double>(pick(2001)) / 1000 - 1);
}

void Rubbish::spoil(PatchFacet& facet) {
  double* const fields[] = {&facet.corners[1][2], &facet.point[0],  &facet.normal[1],
                            &facet.velocity[2],   &facet.stiffness, &facet.damping};
  *fields[pick(6)] = number();
}

ContactPatch Rubbish::patch() {
  ContactPatch patch = flat_square(random_(), 0, 0, pick(2) == 0 ? rigid_stiffness : 300);
  patch.contact_set = pick(3);
  patch.n_facets = pick(4) == 0 ? static_cast<std::uint32_t>(random_()) : pick(3);
  const std::uint32_t spoilt = pick(4);
  for (std::uint32_t i = 0; i < spoilt; ++i) spoil(patch.facets[pick(2)]);
  if (pick(20) == 0) patch.tool = pick(3);
  return patch;
}

RubbishResult feed_rubbish(std::size_t patches, std::uint64_t seed) {
  haptic::Controller controller{haptic::ControllerSettings{}};
  controller.set_state(haptic::HapticState::ready);
  Rubbish rubbish(seed);
  RubbishResult result;
  result.patches = patches;
  result.limit = controller.force_limit();
  haptic::DeviceSample sample;
  sample.has_new = sample.powered = true;
  std::int64_t now = 1'000'000'000;
  for (std::size_t i = 0; i < patches; ++i) {
    now += 1'000'000;
    sample.t_ns = now;
    sample.x = {0.01 * std::sin(1e-3 * static_cast<double>(i)), 0,
                0.01 * std::cos(2e-3 * static_cast<double>(i))};
    // The tick must be newer than the last, or nothing would ever be taken.
    ContactPatch patch = rubbish.patch();
    if (i % 2 == 0) patch.tick = i + 1;
    const Vec3 f = controller.tick(now, sample, &patch).force;
    result.bad_forces += !f.allFinite() || f.norm() > result.limit * (1 + 1e-12);
    if (f.allFinite()) result.force_most = std::max(result.force_most, f.norm());
  }
  result.rejected = controller.patches().rejected();
  result.taken = controller.patches().taken();
  return result;
}

}  // namespace palpate::bench
