#pragma once
// The record of a session whose physics has died and is started again in the same folder.

#include <filesystem>
#include <optional>

namespace palpate::physics {

/// Moves FOLDER/record.h5, if there is one, to the first free name of record_1.h5, record_2.h5, ...
/// @return where it is now. @throws std::runtime_error if it cannot be moved
std::optional<std::filesystem::path> set_earlier_record_aside(const std::filesystem::path& folder);

}  // namespace palpate::physics
