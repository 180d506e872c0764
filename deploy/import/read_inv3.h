#pragma once
// InVesalius projects: a tar.gz with main.plist (shape, spacing, type) and matrix.dat (the cells, x fastest).

#include <string>

#include "common/record/volume.h"

namespace palpate {

/// Size, spacing, orientation and cells. The axial slices of InVesalius run towards the patient's left, front and
/// head: y is mirrored against DICOM. Projects cut along other planes have no orientation.
/// @throws InputError
Volume read_inv3(const std::string& path);

}  // namespace palpate
