#pragma once
// Bare cells, and INRIMAGE-4 files; both also gzipped.

#include <optional>
#include <string>

#include "common/record/volume.h"
#include "deploy/import/voxel_type.h"

namespace palpate {

/// What a person says about a bare image.
struct RawOptions {
  std::optional<std::array<std::int64_t, 3>> size;  // cells along x, y, z
  std::optional<Eigen::Vector3d> spacing;           // [m]
  std::optional<VoxelType> type;                    // little-endian
  std::optional<std::uint64_t> header_bytes;        // skipped at the beginning
  bool any() const { return size || spacing || type || header_bytes; }
};

/// Cells without a header: size, spacing and type must be given. @throws InputError
Volume read_raw(const std::string& path, const RawOptions& options);

/// Its header says all, and what is given as well must agree with it; without one it is as raw. @throws InputError
Volume read_inr(const std::string& path, const RawOptions& options);

}  // namespace palpate
