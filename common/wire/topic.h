#pragma once
// What each message is called on the wire, and with which quality of service it travels (idl/README.md has the table).
// For common/wire only.

#include <dds/dds.h>

#include <memory>

#include "common/message/messages.h"
#include "idl/palpate.h"

namespace palpate {

enum class Service {
  newest,      // best effort, keep last 1 per key: what is missed is replaced by what comes
  blocks,      // the same for many keys at once; through shared memory where there is some
  state,       // reliable, transient local, keep last 1 per key: a late joiner gets all keys
  batches,     // reliable, keep last 64 per key
  everything,  // reliable, keep all
};

template <class M>
struct Topic;  // of a message: Wire, descriptor(), name, service

#define PALPATE_TOPIC(M, SERVICE)                                                                   \
  template <>                                                                                       \
  struct Topic<M> {                                                                                 \
    using Wire = palpate_wire_##M;                                                                  \
    static const dds_topic_descriptor_t* descriptor() noexcept { return &palpate_wire_##M##_desc; } \
    static constexpr const char* name = #M;                                                         \
    static constexpr Service service = SERVICE;                                                     \
  }
PALPATE_TOPIC(ToolState, Service::newest);
PALPATE_TOPIC(ContactPatch, Service::newest);
PALPATE_TOPIC(ToolWrench, Service::newest);
PALPATE_TOPIC(Pointer, Service::newest);
PALPATE_TOPIC(VertexBlock, Service::blocks);
PALPATE_TOPIC(BodySurface, Service::state);
PALPATE_TOPIC(SurfaceChange, Service::state);
PALPATE_TOPIC(NodeStatus, Service::state);
PALPATE_TOPIC(HapticTrace, Service::batches);
PALPATE_TOPIC(Command, Service::everything);
#undef PALPATE_TOPIC

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// The same for topic, writer and reader.
Qos make_qos(Service service);

/// For a reader of blocks where the participant uses shared memory: the depth that DDS means for each key is there the
/// length of one queue for all of them.
void queue_for_all_keys(dds_qos_t& qos);

inline constexpr int most_queued = 256;  // MAX_SUBSCRIBER_QUEUE_CAPACITY of iceoryx 2.0

/// A DDS call's answer, or std::runtime_error "DDS: what TOPIC: why".
dds_entity_t made(dds_entity_t entity, const char* what, const char* topic);

}  // namespace palpate
