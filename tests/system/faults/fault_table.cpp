#include "tests/system/faults/fault_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/system/faults/node_crew.h"

namespace palpate::test {
namespace {

std::string ms(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return "";
  const auto last = static_cast<double>(sorted.size() - 1);
  return fmt::format("{:.0f}", 1e3 * sorted[static_cast<std::size_t>(share * last + 0.5)]);
}

}  // namespace

const char* name_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::killed:
      return "kill -9, started at once";
    case FaultKind::ended:
      return "SIGTERM, started at once";
    case FaultKind::away:
      return "kill -9, started later";
    case FaultKind::stopped:
      return "SIGSTOP, SIGCONT";
  }
  return "";
}

double FaultTable::longest_to_no_force() const {
  double longest = 0;
  for (const auto& result : results_) longest = std::max(longest, result.to_no_force.value_or(0));
  return longest;
}

double FaultTable::longest_to_rejoin() const {
  double longest = 0;
  for (const auto& result : results_) longest = std::max(longest, result.to_rejoin.value_or(0));
  return longest;
}

int FaultTable::rejoins() const { return rejoins(1e9); }

int FaultTable::rejoins(double within_s) const {
  return static_cast<int>(std::count_if(results_.begin(), results_.end(), [&](const FaultResult& result) {
    return result.to_rejoin && *result.to_rejoin < within_s;
  }));
}

int FaultTable::in_contact() const {
  return static_cast<int>(std::count_if(results_.begin(), results_.end(),
                                        [](const FaultResult& result) { return result.in_contact; }));
}

std::string FaultTable::text() const {
  std::string text =
      "| node | fault | times | in contact | to 0 N, longest [ms] | rejoin, median / longest [ms] | largest "
      "rise [N] |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const NodeKind node : crew_nodes)
    for (const FaultKind kind : {FaultKind::killed, FaultKind::ended, FaultKind::away, FaultKind::stopped}) {
      std::vector<double> silences, rejoins;
      int times = 0, contacts = 0;
      double rise = 0;
      for (const auto& result : results_) {
        if (result.node != node || result.kind != kind) continue;
        ++times;
        contacts += result.in_contact ? 1 : 0;
        rise = std::max(rise, result.rise);
        if (result.to_no_force) silences.push_back(*result.to_no_force);
        if (result.to_rejoin) rejoins.push_back(*result.to_rejoin);
      }
      if (times == 0) continue;
      std::sort(silences.begin(), silences.end());
      std::sort(rejoins.begin(), rejoins.end());
      text += fmt::format("| {} | {} | {} | {} | {} | {} / {} | {:.3f} |\n", name_of(node), name_of(kind),
                          times, contacts, ms(silences, 1), ms(rejoins, 0.5), ms(rejoins, 1), rise);
    }
  return text;
}

}  // namespace palpate::test
