#pragma once
// What a node took of what it was sent, and what not, for its part of summary.json.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/wire/refusals.h"

namespace palpate {

/// {"wire": {NODE: {"heard": {TOPIC: {"received", "lost", "foreign", "rejected": {REASON: n}, "first_refused"}}}}}, the last
/// one only if there was one. For json::merge_patch with wire_report.
nlohmann::json heard_report(const std::string& node, const std::vector<Heard>& topics);

}  // namespace palpate
