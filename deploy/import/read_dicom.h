#pragma once
// One DICOM series: all slices of a folder, or the series in it to which a named file belongs.

#include <string>
#include <vector>

#include "common/record/volume.h"

namespace palpate {

/// @param files  written: the files read, in the order of the slices
/// @throws InputError: no DICOM, several series in the folder, files that cannot be read, slices that do not make a box
Volume read_dicom(const std::string& path, std::vector<std::string>& files);

}  // namespace palpate
