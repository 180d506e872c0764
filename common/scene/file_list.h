#pragma once
// Files that a scene names by a pattern.

#include <filesystem>
#include <string>
#include <vector>

namespace palpate {

/// Does a name fit a pattern, in which * stands for any text and ? for any one character?
bool fits_pattern(std::string_view name, std::string_view pattern);

/// Is a before b, where runs of digits count as numbers: slice_2 before slice_10?
bool in_natural_order(std::string_view a, std::string_view b);

/// The files of a folder whose name fits the last part of `pattern`, in natural order. Without * and ? it is the one file, if
/// there is one.
std::vector<std::string> files_of_pattern(const std::filesystem::path& pattern);

}  // namespace palpate
