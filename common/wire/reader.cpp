#include "common/wire/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

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
  Speaker* speaker = nullptr;
  std::atomic<std::uint64_t> kept_out{0};  // foreign samples that DDS was not to keep

  void open(Participant& participant);
  /// DDS asks this before a sample takes the place of another one.
  static bool let_in(const dds_sample_info_t* info, void* inner) noexcept;
  bool is_foreign();
  void reject(const Broken& broken) noexcept;
  void note(std::string_view refusal) noexcept;
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
  if (speaker != nullptr) {
    dds_topic_filter filter = {};
    filter.mode = DDS_TOPIC_FILTER_SAMPLEINFO_ARG;
    filter.f.sampleinfo_arg = &let_in;
    filter.arg = this;
    made(dds_set_topic_filter_extended(topic, &filter), "filter of", name);
  }
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
bool Reader<M>::Inner::let_in(const dds_sample_info_t* info, void* inner) noexcept {
  auto& self = *static_cast<Inner*>(inner);
  if (self.speaker->may_pass(info->publication_handle)) return true;
  self.kept_out.fetch_add(1, std::memory_order_relaxed);
  return false;
}

template <class M>
bool Reader<M>::Inner::is_foreign() {
  if (speaker == nullptr || speaker->admits(reader, Topic<M>::name, sender)) return false;
  if (counts.foreign++ == 0) note(speaker->why_not());
  return true;
}

template <class M>
void Reader<M>::Inner::reject(const Broken& broken) noexcept {
  const bool first =
      std::all_of(counts.rejected.begin(), counts.rejected.end(), [](std::uint64_t n) { return n == 0; });
  ++counts.rejected[static_cast<std::size_t>(broken.reason)];
  if (first) note(fmt::format("{}: {} is {}", Topic<M>::name, name_of(broken), text_of(broken.reason)));
}

template <class M>
void Reader<M>::Inner::note(std::string_view refusal) noexcept {
  if (counts.first_refused[0] != '\0') return;
  std::copy_n(refusal.begin(), std::min(refusal.size(), counts.first_refused.size() - 1),
              counts.first_refused.begin());
}

template <class M>
bool Reader<M>::Inner::fetch(dds_time_t& sent) noexcept {
  if constexpr (many_keys)
    if (inbox) return inbox->pop(wire, sent, sender);
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
    if (is_foreign()) continue;
    if (const Verdict verdict = from_wire(wire, message)) {
      reject(*verdict);
      continue;
    }
    ++counts.received;
    return true;
  }
  return false;
}

template <class M>
Reader<M>::Reader(Participant& participant, Speaker* speaker) : inner_(std::make_unique<Inner>()) {
  inner_->speaker = speaker;
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
bool Reader<M>::is_from(Speaker& speaker) {
  if (speaker.admits(inner_->reader, Topic<M>::name, inner_->sender)) return true;
  if (inner_->counts.foreign++ == 0) inner_->note(speaker.why_not());
  return false;
}

template <class M>
bool Reader<M>::take_newest(M& message) noexcept {
  dds_time_t newest = 0;
  if (!inner_->next(message, newest)) return false;
  std::uint64_t sender = inner_->sender;
  for (dds_time_t sent = 0; inner_->fetch(sent);) {
    if (inner_->is_foreign()) continue;
    const bool newer = sent >= newest;
    const Verdict verdict = newer ? from_wire(inner_->wire, message) : judge(inner_->wire);
    if (verdict) {
      inner_->reject(*verdict);
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
  ReaderCounts counts = inner_->counts;
  counts.foreign += inner_->kept_out.load(std::memory_order_relaxed);
  return counts;
}

template class Reader<ToolState>;
template class Reader<ContactPatch>;
template class Reader<ToolWrench>;
template class Reader<BodySurface>;
template class Reader<SurfaceChange>;
template class Reader<VertexBlock>;
template class Reader<HapticTrace>;
template class Reader<Pointer>;
template class Reader<Command>;
template class Reader<NodeStatus>;

}  // namespace palpate
