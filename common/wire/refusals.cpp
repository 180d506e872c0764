#include "common/wire/refusals.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/wire/broken.h"

namespace palpate {

std::string name_of(const Broken& broken) {
  return broken.list[0] == '\0' ? broken.field : fmt::format("{}.{}", broken.list, broken.field);
}

const char* text_of(RejectReason reason) noexcept {
  switch (reason) {
    case RejectReason::version:
      return "of another version";
    case RejectReason::count:
      return "too many";
    case RejectReason::unknown_id:
      return "not known";
    case RejectReason::not_finite:
      return "not finite";
    case RejectReason::not_unit:
      return "not of length one";
    case RejectReason::out_of_range:
      return "out of range";
    case RejectReason::text:
      return "text without end";
    case RejectReason::other:
      return "out of order";
  }
  return "";
}

const char* key_of(RejectReason reason) noexcept {
  switch (reason) {
    case RejectReason::version:
      return "version";
    case RejectReason::count:
      return "count";
    case RejectReason::unknown_id:
      return "unknown_id";
    case RejectReason::not_finite:
      return "not_finite";
    case RejectReason::not_unit:
      return "not_unit";
    case RejectReason::out_of_range:
      return "out_of_range";
    case RejectReason::text:
      return "text";
    case RejectReason::other:
      return "other";
  }
  return "";
}

std::uint64_t rejected(const ReaderCounts& counts) noexcept {
  std::uint64_t sum = 0;
  for (const std::uint64_t one : counts.rejected) sum += one;
  return sum;
}

ReaderCounts sum(const ReaderCounts& before, const ReaderCounts& now) noexcept {
  ReaderCounts both = before;
  both.received += now.received;
  both.lost += now.lost;
  both.foreign += now.foreign;
  for (std::size_t i = 0; i < both.rejected.size(); ++i) both.rejected[i] += now.rejected[i];
  if (both.first_refused[0] == '\0') both.first_refused = now.first_refused;
  return both;
}

void add_counts(NodeStatus& status, const ReaderCounts& counts) noexcept {
  status.samples_received += counts.received;
  status.samples_lost += counts.lost;
  status.foreign += counts.foreign;
  for (std::size_t i = 0; i < counts.rejected.size(); ++i) status.rejected[i] += counts.rejected[i];
  if (status.refused[0] == '\0') status.refused = counts.first_refused;
}

void clear_counts(NodeStatus& status) noexcept {
  status.samples_received = status.samples_lost = status.foreign = 0;
  status.rejected = {};
  status.refused = {};
}

}  // namespace palpate
