#pragma once
// Receives one kind of message. M: any of the nine structs of common/message/messages.h. A sample that breaks a
// promise of its message is dropped whole and counted by reason.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>

#include "common/message/messages.h"
#include "common/wire/participant.h"

namespace palpate {

struct ReaderCounts {
  std::uint64_t received = 0;                       // good samples taken
  std::uint64_t lost = 0;                           // gaps in the writers' numbering, as DDS saw them
  std::array<std::uint64_t, n_tallies> rejected{};  // by RejectReason
};

template <class M>
class Reader {
 public:
  /// @throws std::runtime_error if DDS refuses
  explicit Reader(Participant& participant);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // One thread at a time; neither call waits, and nothing of ours allocates.

  /// The next good sample not yet taken: in the order sent per key, the newest one per key on latest-value topics.
  /// @return false if there is none; `message` is then as it was
  bool take(M& message) noexcept;

  /// Which writer the message taken last came from: a number that changes when another one takes over. 0: none yet.
  std::uint64_t sender() const noexcept;

  /// Takes all there is and gives the one sent last, whatever its key. For topics of which one key is expected.
  bool take_newest(M& message) noexcept;

  /// Sleeps until something has come or the time is over. @return true if something is there to take
  bool wait(std::chrono::nanoseconds at_most) noexcept;

  /// How many writers this reader has now.
  int matched() noexcept;

  ReaderCounts counts() noexcept;

 private:
  struct Inner;
  std::unique_ptr<Inner> inner_;
};

}  // namespace palpate
