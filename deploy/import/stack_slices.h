#pragma once
// Single slices with positions become a volume.

#include <string>
#include <vector>

#include "common/record/volume.h"

namespace palpate {

/// One cell thick; volume.origin and volume.orientation say where it is.
struct Slice {
  std::string file;
  Volume volume;
};

/// Sorts by the position along the common normal, the third column of the orientation.
void sort_slices(std::vector<Slice>& slices);

/// Stacks sorted slices. They must have the same size, spacing and orientation, and steps that are equal (to 10 %)
/// and along the normal. @throws InputError beginning with `where`
Volume stack_slices(const std::string& where, const std::vector<Slice>& slices);

}  // namespace palpate
