#pragma once
// The part of summary.json that physics knows. Keys and units: docs/reference/summary.md.

#include <nlohmann/json.hpp>

#include "physics_node/record/recorder.h"
#include "physics_node/world.h"

namespace palpate::physics {

/// @param recorder  for the tools' peaks and traces; null where nothing was recorded
/// @param began_t  what a record was run again to before `wall_s` began [s]
nlohmann::json physics_summary(const World& world, const Recorder* recorder, double wall_s,
                               double began_t = 0);

}  // namespace palpate::physics
