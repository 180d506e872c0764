#pragma once
// What a node has said, for its part of summary.json.

#include <nlohmann/json.hpp>
#include <string>

#include "common/wire/participant.h"
#include "common/wire/writer.h"

namespace palpate {

/// {"wire": {NODE: {"shared_memory": whether, TOPIC: {"samples": n, "bytes": n}, ...}}}; "broken": n where there were some
template <class... Writers>
nlohmann::json wire_report(const std::string& node, const Participant& participant,
                           const Writers&... writers) {
  nlohmann::json report = {{"shared_memory", participant.shared_memory()}};
  const auto add = [&report](const auto& writer) {
    const WriterCounts counts = writer.counts();
    report[writer.topic()] = {{"samples", counts.samples}, {"bytes", counts.bytes}};
    if (counts.broken > 0) report[writer.topic()]["broken"] = counts.broken;
  };
  (add(writers), ...);
  return {{"wire", {{node, report}}}};
}

}  // namespace palpate
