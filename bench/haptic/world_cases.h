#pragma once
// Cases of the matrix with a slab of the real physics library in place of a mass on a spring.

#include <string>
#include <vector>

#include "bench/haptic/matrix.h"

namespace palpate::bench {

/// Steps of force beyond K (v T + q) that a tick may make [N].
inline constexpr double world_step_limit = 0.1;

Case case_of(const SlabModel& slab);

/// All slabs and hands over all links.
std::vector<Case> world_cases(Effort effort, RenderMode mode, const DeviceModel& device);

/// "72 cases: 0 above 200 um, ..."
std::string world_figure(const Tally& tally);

}  // namespace palpate::bench
