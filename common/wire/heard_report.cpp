#include "common/wire/heard_report.h"

#include <fmt/format.h>

#include "common/report/warnings.h"

namespace palpate {

void add_heard(nlohmann::json& part, const std::string& node, const std::vector<Heard>& topics) {
  nlohmann::json report = nlohmann::json::object();
  for (const auto& [topic, counts] : topics) {
    nlohmann::json& one = report[topic];
    one = {{"received", counts.received}, {"lost", counts.lost}, {"foreign", counts.foreign}};
    one["rejected"] = nlohmann::json::object();
    for (std::size_t i = 0; i < counts.rejected.size(); ++i)
      if (counts.rejected[i] > 0) one["rejected"][key_of(static_cast<RejectReason>(i))] = counts.rejected[i];
    if (counts.first_refused[0] == '\0') continue;
    one["first_refused"] = counts.first_refused.data();
    add_warning(part, fmt::format("{} did not take {} samples of {}; the first: {}", node,
                                  counts.foreign + rejected(counts), topic, counts.first_refused.data()));
  }
  part.merge_patch({{"wire", {{node, {{"heard", report}}}}}});
}

}  // namespace palpate
