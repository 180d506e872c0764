#include "common/wire/writer.h"

#include <atomic>

#include "common/wire/convert.h"
#include "common/wire/topic.h"

namespace palpate {

template <class M>
struct Writer<M>::Inner {
  dds_entity_t topic = 0;
  dds_entity_t writer = 0;
  typename Topic<M>::Wire wire{};  // what is being sent
  std::atomic<std::uint64_t> samples{0};
  std::atomic<std::uint64_t> broken{0};
};

template <class M>
Writer<M>::Writer(Participant& participant) : inner_(std::make_unique<Inner>()) {
  const Qos qos = make_qos(Topic<M>::service);
  inner_->topic =
      made(dds_create_topic(participant.handle(), Topic<M>::descriptor(), Topic<M>::name, qos.get(), nullptr),
           "topic", Topic<M>::name);
  if (!participant.identity()
           .role.empty()) {  // with each writer, so that a reader knows from the first sample whose it is
    const std::string text = to_text(participant.identity());
    dds_qset_userdata(qos.get(), text.data(), text.size());
  }
  inner_->writer = made(dds_create_writer(participant.handle(), inner_->topic, qos.get(), nullptr),
                        "writer of", Topic<M>::name);
}

template <class M>
Writer<M>::~Writer() {
  dds_delete(inner_->writer);
  dds_delete(inner_->topic);
}

template <class M>
bool Writer<M>::write(const M& message) noexcept {
  to_wire(message, inner_->wire);
  if (judge(inner_->wire)) {
    inner_->broken.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  if (dds_write(inner_->writer, &inner_->wire) != DDS_RETCODE_OK) return false;
  inner_->samples.fetch_add(1, std::memory_order_relaxed);
  return true;
}

template <class M>
WriterCounts Writer<M>::counts() const noexcept {
  const std::uint64_t samples = inner_->samples.load(std::memory_order_relaxed);
  return {samples, samples * sizeof inner_->wire, inner_->broken.load(std::memory_order_relaxed)};
}

template <class M>
const char* Writer<M>::topic() const noexcept {
  return Topic<M>::name;
}

template <class M>
int Writer<M>::matched() noexcept {
  dds_publication_matched_status_t status = {};
  if (dds_get_publication_matched_status(inner_->writer, &status) != DDS_RETCODE_OK) return 0;
  return static_cast<int>(status.current_count);
}

template <class M>
std::uint64_t Writer<M>::matched_ever() noexcept {
  dds_publication_matched_status_t status = {};
  if (dds_get_publication_matched_status(inner_->writer, &status) != DDS_RETCODE_OK) return 0;
  return status.total_count;
}

template class Writer<ToolState>;
template class Writer<ContactPatch>;
template class Writer<ToolWrench>;
template class Writer<BodySurface>;
template class Writer<SurfaceChange>;
template class Writer<VertexBlock>;
template class Writer<HapticTrace>;
template class Writer<Pointer>;
template class Writer<Command>;
template class Writer<NodeStatus>;

}  // namespace palpate
