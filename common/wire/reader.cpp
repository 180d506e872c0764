#include "common/wire/reader.h"

#include "common/wire/convert.h"
#include "common/wire/topic.h"

namespace palpate {

template <class M>
struct Reader<M>::Inner {
  dds_entity_t topic = 0;
  dds_entity_t reader = 0;
  dds_entity_t waitset = 0;
  typename Topic<M>::Wire wire{};  // what is being taken
  ReaderCounts counts;
  std::uint64_t sender = 0;

  /// Takes samples until a good one has been written to `message`. @return false if none was left
  bool next(M& message, dds_time_t& sent) noexcept;
};

template <class M>
bool Reader<M>::Inner::next(M& message, dds_time_t& sent) noexcept {
  void* samples[1] = {&wire};
  dds_sample_info_t info = {};
  while (dds_take(reader, samples, &info, 1, 1) == 1) {
    if (!info.valid_data) continue;  // a writer has gone
    if (const Verdict verdict = from_wire(wire, message)) {
      ++counts.rejected[static_cast<std::size_t>(*verdict)];
      continue;
    }
    ++counts.received;
    sent = info.source_timestamp;
    sender = info.publication_handle;
    return true;
  }
  return false;
}

template <class M>
Reader<M>::Reader(Participant& participant) : inner_(std::make_unique<Inner>()) {
  const dds_entity_t owner = participant.handle();
  const char* name = Topic<M>::name;
  const Qos qos = make_qos(Topic<M>::service);
  inner_->topic =
      made(dds_create_topic(owner, Topic<M>::descriptor(), name, qos.get(), nullptr), "topic", name);
  inner_->reader = made(dds_create_reader(owner, inner_->topic, qos.get(), nullptr), "reader of", name);
  inner_->waitset = made(dds_create_waitset(owner), "waitset of", name);
  const dds_entity_t condition =
      made(dds_create_readcondition(inner_->reader, DDS_ANY_STATE), "condition of", name);
  made(dds_waitset_attach(inner_->waitset, condition, 0), "waitset of", name);
}

template <class M>
Reader<M>::~Reader() {
  dds_delete(inner_->waitset);
  dds_delete(inner_->reader);
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
  void* samples[1] = {&inner_->wire};
  dds_sample_info_t info = {};
  while (dds_take(inner_->reader, samples, &info, 1, 1) == 1) {
    if (!info.valid_data) continue;
    const bool newer = info.source_timestamp >= newest;
    const Verdict verdict = newer ? from_wire(inner_->wire, message) : judge(inner_->wire);
    if (verdict) {
      ++inner_->counts.rejected[static_cast<std::size_t>(*verdict)];
      continue;
    }
    ++inner_->counts.received;
    if (!newer) continue;
    newest = info.source_timestamp;
    inner_->sender = info.publication_handle;
  }
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
