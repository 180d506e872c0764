#pragma once
// Receives one kind of message. M: any of the structs of common/message/messages.h. A sample that breaks a
// promise of its message is dropped whole and counted by reason; one of a process that may not speak here is not looked at.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>

#include "common/message/messages.h"
#include "common/wire/participant.h"
#include "common/wire/speaker.h"

namespace palpate {

struct ReaderCounts {
  std::uint64_t received = 0;                       // good samples taken
  std::uint64_t lost = 0;                           // gaps in the writers' numbering, as DDS saw them
  std::array<std::uint64_t, n_tallies> rejected{};  // by RejectReason
  std::uint64_t foreign = 0;                        // of processes that may not speak here
  std::array<char, 128> first_refused{};            // the first of both, and why; empty: none
};

template <class M>
class Reader {
 public:
  /// @param speaker  who may speak; null: everybody. Must outlive the reader; where several readers share one, all of them
  ///                 are read by one thread
  /// @throws std::runtime_error if DDS refuses
  explicit Reader(Participant& participant, Speaker* speaker = nullptr);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // One thread at a time; neither call waits, and nothing of ours allocates but for a process that was never heard before.

  /// The next good sample not yet taken: in the order sent per key, the newest one per key on latest-value topics.
  /// @return false if there is none; `message` is then as it was
  bool take(M& message) noexcept;

  /// Which writer the message taken last came from: a number that changes when another one takes over. 0: none yet.
  std::uint64_t sender() const noexcept;

  /// Whether the message taken last came from who may speak as `speaker`. For topics on which several speak, each for himself.
  bool is_from(Speaker& speaker);

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
