#pragma once
// From a person's image to a palpate volume.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/record/volume.h"
#include "deploy/import/read_raw.h"

namespace palpate {

struct ImportOptions {
  std::string input;                            // file, or folder of a DICOM series
  bool phantom = false;                         // no image: the made aneurysm
  RawOptions raw;                               // for .raw and .inr only; of a phantom the size alone
  std::optional<std::array<int, 3>> partition;  // cells along x, y, z; absent: as in the image
  std::string transfer;                         // "ct", "grey"; empty: by the range of the image
};

/// Reads, checks, colours and resamples.
/// @param files  if given, written: the files that the volume is made of; none of a phantom
/// @throws InputError, std::bad_alloc
Volume import_image(const ImportOptions& options, std::vector<std::string>* files = nullptr);

}  // namespace palpate
