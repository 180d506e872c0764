#pragma once
// What a person probably meant.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

/// The known word that `given` looks like: few letters wrong, or the same word without its unit
/// ("radius" for "radius_mm"). Nothing if none is close.
std::optional<std::string> near_miss(std::string_view given, const std::vector<std::string>& known);

/// Advice for a word that is not among the known ones: 'did you mean "x"?' or the list of all.
/// @param noun  what the known ones are called, plural: "known keys"
std::string advice(std::string_view given, const std::vector<std::string>& known, std::string_view noun);

/// '"a", "b" or "c"'
std::string quoted_list(const std::vector<std::string>& words, std::string_view last_joint = "or");

}  // namespace palpate
