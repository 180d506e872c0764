#pragma once
// Publishes one kind of message. M: any of the structs of common/message/messages.h.

#include <cstdint>
#include <memory>

#include "common/message/messages.h"
#include "common/wire/participant.h"

namespace palpate {

/// What has been handed to DDS. On the network each sample also has the headers of RTPS, UDP and IP, once a datagram.
struct WriterCounts {
  std::uint64_t samples = 0;
  std::uint64_t bytes = 0;   // of the samples
  std::uint64_t broken = 0;  // messages that broke their own promises and were not sent
};

template <class M>
class Writer {
 public:
  /// @throws std::runtime_error if DDS refuses
  explicit Writer(Participant& participant);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Sends a message. One thread at a time. Nothing of ours allocates; DDS may, and may now and then take milliseconds
  /// (reliable topics: until a slow reader has caught up), so never from the haptic real-time thread.
  /// @return false if the message breaks its own promises (convert.h) or DDS could not send it: nothing was sent
  bool write(const M& message) noexcept;

  /// How many readers this writer has now.
  int matched() noexcept;
  /// How many it has ever had: grows with each that comes, whoever leaves meanwhile.
  std::uint64_t matched_ever() noexcept;

  /// Any thread.
  WriterCounts counts() const noexcept;
  const char* topic() const noexcept;

 private:
  struct Inner;
  std::unique_ptr<Inner> inner_;
};

}  // namespace palpate
