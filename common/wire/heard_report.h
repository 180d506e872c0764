#pragma once
// What a node took of what it was sent, and what not, for its part of summary.json.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/wire/refusals.h"

namespace palpate {

/// Adds to a node's part {"wire": {NODE: {"heard": {TOPIC: {"received", "lost", "foreign", "rejected": {REASON: n},
/// "first_refused"}}}}}, the last one only if there was one, and a warning for each topic of which not all was taken.
void add_heard(nlohmann::json& part, const std::string& node, const std::vector<Heard>& topics);

}  // namespace palpate
