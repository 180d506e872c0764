#pragma once
// The key "warnings" of summary.json: an array of lines that a person should read.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace palpate {

/// Appends a line to summary["warnings"], which it makes where there is none. A line that is there already is not repeated.
/// @param text  what is wrong, with its numbers and units, and what would be right; no newline
void add_warning(nlohmann::json& summary, std::string text);
void add_warnings(nlohmann::json& summary, std::span<const std::string> texts);

/// Writes how many lines there are into summary["guard"]["warnings"], for tools that count; once, after the last line.
void count_warnings(nlohmann::json& summary);

/// The lines of summary["warnings"]; none where there is no such key, or one of another kind.
std::vector<std::string> warnings_of(const nlohmann::json& summary);

}  // namespace palpate
