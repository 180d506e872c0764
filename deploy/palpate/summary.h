#pragma once
// One summary.json out of what the nodes left in parts/.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/scene/scene_fwd.h"
#include "deploy/palpate/session.h"

namespace palpate::deploy {

/// The keys of all parts in one object, with "nodes" (what became of each), and "scene", "commit", "seed" and "wall_s"
/// where no node said them. "warnings" holds the lines of all nodes, one after the other. A part that is missing is left out; one that is not JSON is named on stderr and left out.
nlohmann::json merged_summary(const std::filesystem::path& out, const Scene& scene,
                              const SessionResult& result);

/// Writes OUT/summary.json and removes OUT/parts. @return path of the summary
std::filesystem::path write_summary(const std::filesystem::path& out, const Scene& scene,
                                    const SessionResult& result);

}  // namespace palpate::deploy
