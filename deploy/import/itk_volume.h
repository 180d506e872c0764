#pragma once
// What ITK read, checked and as a Volume in SI.

#include <string>

#include "common/record/volume.h"
#include "deploy/import/read_itk.h"

namespace palpate {

/// One file: size, spacing, origin, cells; the orientation always (the identity where the file has none).
/// @throws InputError: damaged, truncated, colours, absurd size or spacing, axes that are not at right angles
Volume itk_volume(const std::string& path, ItkFormat format);

}  // namespace palpate
