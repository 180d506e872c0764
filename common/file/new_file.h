#pragma once
// Files that palpate leaves are new: never what a link points to, and nothing of an older file remains, its
// rights neither.

#include <cstdio>
#include <string>

namespace palpate {

/// Removes a file or a link (itself, not what it points to) that lies at `path`. What is no file stays.
/// @return false, and errno: it could not be removed
bool make_way(const std::string& path) noexcept;

/// Makes a file where none is, after make_way(). @return to write to; nullptr, and errno says why
std::FILE* open_new(const std::string& path) noexcept;

}  // namespace palpate
