#pragma once
// The newest sample of each key, taken from a DDS reader as soon as it comes. For common/wire only.
// Why: over shared memory all keys of a reader share one queue of at most 256 samples, and a sample that is not taken keeps
// its place in the writer's memory. So what has many keys is copied out at once, however slow the person's picture is.

#include <dds/dds.h>

#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace palpate {

/// Wire: a generated type. Key: what tells its instances apart.
template <class Wire, class Key>
class Inbox {
 public:
  /// @param key_of     of a sample
  /// @param something  a guard condition that is true while something waits here
  Inbox(Key (*key_of)(const Wire&), dds_entity_t something) : key_of_(key_of), something_(something) {}

  /// Takes all that the reader has; called by DDS in threads of its own.
  void drain(dds_entity_t reader) noexcept {
    const std::lock_guard lock(mutex_);
    void* samples[1] = {&scratch_};
    dds_sample_info_t info = {};
    while (dds_take(reader, samples, &info, 1, 1) == 1)
      if (info.valid_data) put(info.source_timestamp, info.publication_handle);
    dds_set_guardcondition(something_, !due_.empty());
  }

  /// The newest sample of one key. @return false if nothing waits
  bool pop(Wire& wire, dds_time_t& sent, std::uint64_t& sender) noexcept {
    const std::lock_guard lock(mutex_);
    if (due_.empty()) return false;
    auto node = due_.extract(due_.begin());
    wire = node.mapped()->wire;
    sent = node.mapped()->sent;
    sender = node.mapped()->sender;
    spare_.push_back(std::move(node.mapped()));
    if (due_.empty()) dds_set_guardcondition(something_, false);
    return true;
  }

 private:
  struct Letter {
    Wire wire;
    dds_time_t sent;
    std::uint64_t sender;
  };

  void put(dds_time_t sent, std::uint64_t sender) {
    const Key key = key_of_(scratch_);
    if (due_.size() >= most_keys && due_.count(key) == 0) return;
    auto& letter = due_[key];
    if (letter && letter->sent > sent) return;
    if (!letter && !spare_.empty()) {
      letter = std::move(spare_.back());
      spare_.pop_back();
    }
    if (!letter) letter = std::make_unique<Letter>();
    letter->wire = scratch_;
    letter->sent = sent;
    letter->sender = sender;
  }

  // Why: keys are what a stranger says they are. 110 MB of blocks, 8 million vertices of one picture.
  static constexpr std::size_t most_keys = 4096;

  Key (*key_of_)(const Wire&);
  dds_entity_t something_;
  std::mutex mutex_;  // of all below
  Wire scratch_{};
  std::map<Key, std::unique_ptr<Letter>> due_;
  std::vector<std::unique_ptr<Letter>> spare_;
};

}  // namespace palpate
