#pragma once
// What physics tells the eye leaves through a thread of its own: a slow or broken network never holds up a frame.

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "common/message/messages.h"
#include "common/wire/writer.h"

namespace palpate::physics {

class EyeSender {
 public:
  /// @param repeat  send blocks that rest again in turn, one each 33 ms: where datagrams get lost, a picture of tissue
  ///                that has come to rest would stay wrong otherwise
  EyeSender(Participant& participant, bool repeat);
  ~EyeSender();  // what has not gone by then is not sent
  EyeSender(const EyeSender&) = delete;
  EyeSender& operator=(const EyeSender&) = delete;

  /// All copy and return; what waits and is outdated by the new one is dropped. Cost: a copy, and an allocation where
  /// nothing of this chunk, page or block waits.
  void post(const BodySurface& chunk);
  void post(const SurfaceChange& page);
  void post(const VertexBlock& block);

  int watchers() noexcept { return blocks_.matched(); }
  std::uint64_t watchers_ever() noexcept { return blocks_.matched_ever(); }

  /// Waits until all that was posted has been handed to DDS, or for so long. @return true: it has
  bool drain(std::chrono::milliseconds at_most);

  /// Bodies of whose surface a part could not be sent, since the last call: what changed behind it is lost to its readers.
  std::set<std::uint32_t> take_incomplete();

  const Writer<BodySurface>& surfaces() const noexcept { return surfaces_; }
  const Writer<SurfaceChange>& changes() const noexcept { return changes_; }
  const Writer<VertexBlock>& blocks() const noexcept { return blocks_; }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // body, and its chunk, page or block
  template <class M>
  using Due = std::map<Key, std::unique_ptr<M>>;
  void send();
  template <class M>
  void send_surely(Due<M>& due, Writer<M>& writer, std::unique_lock<std::mutex>& lock);
  void begin_ahead(std::uint32_t body);
  bool send_ahead(std::uint32_t body, std::unique_lock<std::mutex>& lock);
  void send_block(Key which, std::unique_lock<std::mutex>& lock);
  void send_again(std::unique_lock<std::mutex>& lock);

  Writer<BodySurface> surfaces_;
  Writer<SurfaceChange> changes_;
  Writer<VertexBlock> blocks_;
  bool repeat_;
  std::mutex mutex_;  // of all below
  std::condition_variable something_, nothing_left_;
  Due<BodySurface> surfaces_due_;
  Due<SurfaceChange> changes_due_;
  Due<VertexBlock> blocks_due_;
  std::set<Key> ahead_;    // blocks that went before the surface or the changes that are due
  Due<VertexBlock> sent_;  // of the newest revision; empty unless repeat
  std::map<std::uint32_t, std::uint32_t> revision_;  // newest of each body
  std::set<std::uint32_t> incomplete_;
  Key last_again_{0, 0};
  int refusals_ = 0;  // of the chunk or page that is tried now
  bool end_ = false, waits_ = false;
  std::thread thread_;
};

}  // namespace palpate::physics
