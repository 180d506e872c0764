#pragma once
// What a killed session has left, made readable for every program.

#include <string>

namespace palpate::physics {

/// Takes the mark "open for writing" off a record that was not closed. Leaves a record that was closed as it is.
/// @return true if there was something to mend
/// @throws InputError: no record, may not be written, damaged
bool mend_record(const std::string& path);

}  // namespace palpate::physics
