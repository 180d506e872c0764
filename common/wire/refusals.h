#pragma once
// What a node did not take of what it was sent, for its status.

#include <string>

#include "common/message/messages.h"
#include "common/wire/reader.h"

namespace palpate {

/// As in {"rejected": {"not_finite": 3}}.
const char* key_of(RejectReason reason) noexcept;

/// Samples rejected, whatever the reason.
std::uint64_t rejected(const ReaderCounts& counts) noexcept;

/// Of a reader and the one that took its place.
ReaderCounts sum(const ReaderCounts& before, const ReaderCounts& now) noexcept;

/// Sums counts of several readers in a status; the first refusal is that of the first reader that had one.
void clear_counts(NodeStatus& status) noexcept;
void add_counts(NodeStatus& status, const ReaderCounts& counts) noexcept;

struct Heard {
  std::string topic;
  ReaderCounts counts;
};

}  // namespace palpate
