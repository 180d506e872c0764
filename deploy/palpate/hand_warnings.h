#pragma once
// What the counts of the hand mean, in words, for the key "warnings" of summary.json.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpate::deploy {

/// One line for each count of `haptic` in the summary that a person should look at; none where all went well. Faults only
/// where nobody has said yet which tool had one and why.
enum class Faults { counted, named };
std::vector<std::string> hand_warnings(const nlohmann::json& summary, Faults faults);

}  // namespace palpate::deploy
