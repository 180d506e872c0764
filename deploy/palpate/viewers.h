#pragma once
// What a session leaves for ParaView.

#include <filesystem>

#include "common/scene/scene_fwd.h"

namespace palpate::deploy {

/// Writes record.pvd and vtk/ beside OUT/record.h5 if positions were recorded, and says where. What hinders it is said and is no
/// failure: the record is there, and `palpate export` makes them later.
void export_for_viewers(const std::filesystem::path& out, const Scene& scene);

}  // namespace palpate::deploy
