#pragma once
// A scene in a process of its own: CPU time of its frames, and memory.

#include <cstdint>
#include "common/scene/scene_fwd.h"

namespace palpate::bench {

struct SceneCost {
  double us_per_frame = 0;              // CPU time of all threads
  double load_s = 0;                    // CPU time of building the world
  double load_MB = 0;                   // resident memory that the world takes once it has run
  double peak_MB = 0;                   // most that the process ever had
  double asleep = 0;                    // share of masses, at the end
  std::int64_t masses = 0, moving = 0;  // in all; not held
};

/// Runs `frames` frames after a tenth as many that do not count. @throws std::runtime_error if the process fails
SceneCost measure_scene(const Scene& scene, int frames, bool shaken);

}  // namespace palpate::bench
