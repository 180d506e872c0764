#pragma once
// Reports as JSON files that are either complete or absent.

#include <nlohmann/json.hpp>
#include <string>

namespace palpate {

/// Writes `value`, indented, beside `path` and renames it into place: a reader never sees half a file.
/// Numbers that are not finite become null (JSON has no word for them).
/// @throws InputError naming the path: no such folder, no right to write; std::runtime_error: disk full
void write_json(const std::string& path, const nlohmann::json& value);

/// Reads a whole file. @throws InputError "path: what": missing, not readable, not JSON
nlohmann::json read_json(const std::string& path);

}  // namespace palpate
