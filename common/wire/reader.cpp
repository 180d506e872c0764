#include "common/wire/reader.h"

#include "common/wire/convert.h"
#include "common/wire/inbox.h"
#include "common/wire/topic.h"

namespace palpate {
namespace {

using BlockKey = std::uint64_t;
using BlockInbox = Inbox<Topic<VertexBlock>::Wire, BlockKey>;

BlockKey key_of(const Topic<VertexBlock>::Wire& block) { return (BlockKey{block.body} << 32U) | block.block; }

void drain(dds_entity_t reader, void* inbox) { static_cast<BlockInbox*>(inbox)->drain(reader); }

}  // namespace

template <class M>
struct Reader<M>::Inner {
  static constexpr bool many_keys = Topic<M>::service == Service::blocks;
  dds_entity_t topic = 0;
  dds_entity_t reader = 0;
  dds_entity_t waitset = 0;
  dds_entity_t something = 0;         // a condition: true while there is something to take
  std::unique_ptr<BlockInbox> inbox;  // of many keys over shared memory
  typename Topic<M>::Wire wire{};     // what is being taken
  ReaderCounts counts;
  std::uint64_t sender = 0;

  void open(Participant& participant);
  /// Takes a sample into `wire`. @return false if none was left
  bool fetch(dds_time_t& sent) noexcept;
  /// Fetches samples until a good one has been written to `message`. @return false if none was left
  bool next(M& message, dds_time_t& sent) noexcept;
};

template <class M>
void Reader<M>::Inner::open(Participant& participant) {
  const dds_entity_t owner = participant.handle();
  const char* name = Topic<M>::name;
  const Qos qos = make_qos(Topic<M>::service);
  topic = made(dds_create_topic(owner, Topic<M>::descriptor(), name, qos.get(), nullptr), "topic", name);
  dds_listener_t* listener = nullptr;
  if constexpr (many_keys) {
    if (participant.shared_memory()) {
      queue_for_all_keys(*qos);
      something = made(dds_create_guardcondition(owner), "condition of", name);
      inbox = std::make_unique<BlockInbox>(&key_of, something);
      listener = dds_create_listener(inbox.get());
      dds_lset_data_available(listener, &drain);
    }
  }
  reader = dds_create_reader(owner, topic, qos.get(), listener);
  dds_delete_listener(listener);
  made(reader, "reader of", name);
  waitset = made(dds_create_waitset(owner), "waitset of", name);
  if (!inbox) something = made(dds_create_readcondition(reader, DDS_ANY_STATE), "condition of", name);
  made(dds_waitset_attach(waitset, something, 0), "waitset of", name);
}

template <class M>
bool Reader<M>::Inner::fetch(dds_time_t& sent) noexcept {
  if constexpr (many_keys)
    if (inbox) return inbox->pop(wire, sent);
  void* samples[1] = {&wire};
  dds_sample_info_t info = {};
  while (dds_take(reader, samples, &info, 1, 1) == 1) {
    if (!info.valid_data) continue;  // a writer has gone
    sent = info.source_timestamp;
    sender = info.publication_handle;
    return true;
  }
  return false;
}

template <class M>
bool Reader<M>::Inner::next(M& message, dds_time_t& sent) noexcept {
  while (fetch(sent)) {
    if (const Verdict verdict = from_wire(wire, message)) {
      ++counts.rejected[static_cast<std::size_t>(verdict->reason)];
      continue;
    }
    ++counts.received;
    return true;
  }
  return false;
}

template <class M>
Reader<M>::Reader(Participant& participant) : inner_(std::make_unique<Inner>()) {
  inner_->open(participant);
}

template <class M>
Reader<M>::~Reader() {
  dds_delete(inner_->waitset);
  dds_delete(inner_->reader);  // waits for what DDS is about to tell the inbox
  if (inner_->inbox) dds_delete(inner_->something);
  dds_delete(inner_->topic);
}

template <class M>
bool Reader<M>::take(M& message) noexcept {
  dds_time_t sent = 0;
  return inner_->next(message, sent);
}

template <class M>
std::uint64_t Reader<M>::sender() const noexcept {
  return inner_->sender;
}

template <class M>
bool Reader<M>::take_newest(M& message) noexcept {
  dds_time_t newest = 0;
  if (!inner_->next(message, newest)) return false;
  std::uint64_t sender = inner_->sender;
  for (dds_time_t sent = 0; inner_->fetch(sent);) {
    const bool newer = sent >= newest;
    const Verdict verdict = newer ? from_wire(inner_->wire, message) : judge(inner_->wire);
    if (verdict) {
      ++inner_->counts.rejected[static_cast<std::size_t>(verdict->reason)];
      continue;
    }
    ++inner_->counts.received;
    if (!newer) continue;
    newest = sent;
    sender = inner_->sender;
  }
  inner_->sender = sender;
  return true;
}

template <class M>
bool Reader<M>::wait(std::chrono::nanoseconds at_most) noexcept {
  return dds_waitset_wait(inner_->waitset, nullptr, 0, std::max<dds_duration_t>(at_most.count(), 0)) > 0;
}

template <class M>
int Reader<M>::matched() noexcept {
  dds_subscription_matched_status_t status = {};
  if (dds_get_subscription_matched_status(inner_->reader, &status) != DDS_RETCODE_OK) return 0;
  return static_cast<int>(status.current_count);
}

template <class M>
ReaderCounts Reader<M>::counts() noexcept {
  dds_sample_lost_status_t status = {};
  if (dds_get_sample_lost_status(inner_->reader, &status) == DDS_RETCODE_OK)
    inner_->counts.lost = status.total_count;
  return inner_->counts;
}

template class Reader<ToolState>;
template class Reader<ContactPatch>;
template class Reader<ToolWrench>;
template class Reader<BodySurface>;
template class Reader<VertexBlock>;
template class Reader<HapticTrace>;
template class Reader<Pointer>;
template class Reader<Command>;
template class Reader<NodeStatus>;

}  // namespace palpate
