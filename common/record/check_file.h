#pragma once
// Is every number of a file still the one that was written?

#include <string>

namespace palpate {

/// Reads every dataset of a record once, so that a checksum that does not fit is found. Cost: that of reading the file.
/// @throws InputError naming the file and the dataset, with the rows where it grows
void check_file(const std::string& path);

}  // namespace palpate
