#pragma once
// The positions of a record as files that ParaView and VTK open.

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/scene/scene_fwd.h"

namespace palpate::physics {

struct VtkWish {
  std::filesystem::path folder;            // record.pvd and vtk/ are made in it
  double rate_Hz = 10;                     // of the times written, at most those recorded
  std::uint64_t most_bytes = 200'000'000;  // fewer times are written where they would take more
};

struct VtkExport {
  std::filesystem::path collection;  // empty: the record holds no positions
  std::size_t times = 0;
  std::uint64_t bytes = 0;
  double every_s = 0;    // between two times written
  bool thinned = false;  // to keep to most_bytes
};

/// Writes, with the access rights of the record:
///   record.pvd                   all of them over time
///   vtk/body_NAME_00001.vtp ...  the visible surface of a body then, as its elements lived; on its masses displacement [m]
///                                (3) and, where the body yields, yielded_share [0, 1]
///   vtk/scenery_NAME.vtp         its rigid part, if there is one
///   vtk/tools_00001.vtp ...      tips; force [N] (3) and moment [N m] (3) on each tool
/// Files of an earlier export into that folder are replaced; others stay.
/// Cost: 28 bytes a mass of the surface and 24 a facet, each time; 5 ms for 10,000 facets.
/// @param scene  of the record, with its files laid out
/// @throws InputError: the record and the scene do not fit; std::runtime_error: disk full
VtkExport export_vtk(const std::string& record, const Scene& scene, const VtkWish& wish);

}  // namespace palpate::physics
