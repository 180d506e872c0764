#include "common/wire/topic.h"

#include <fmt/format.h>

#include <stdexcept>

namespace palpate {
namespace {

constexpr int batches_kept = 64;
// A new surface of a whole head is tens of megabytes: its writer waits for a slow reader, and then tries again.
constexpr dds_duration_t state_patience = DDS_MSECS(200);
constexpr dds_duration_t patience = DDS_MSECS(100);

}  // namespace

Qos make_qos(Service service) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  // A node that ends takes nothing back: what it said last stays said.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  // Only blocks go through shared memory. What must arrive cannot: iceoryx keeps neither the newest of each key for who
  // comes late nor what a slow reader has not taken. What is small gains nothing there (docs/benchmarks.md), and the hand
  // shall not depend on RouDi. Cyclone DDS 0.10 leaves out whoever's liveliness is not automatic; without a lease that
  // means nothing else.
  if (service != Service::blocks)
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_INFINITY);
  switch (service) {
    case Service::newest:
    case Service::blocks:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
      break;
    case Service::state:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, state_patience);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
      dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
      dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                                  DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
      break;
    case Service::batches:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, patience);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, batches_kept);
      break;
    case Service::everything:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, patience);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
      break;
  }
  return qos;
}

void queue_for_all_keys(dds_qos_t& qos) { dds_qset_history(&qos, DDS_HISTORY_KEEP_LAST, most_queued); }

dds_entity_t made(dds_entity_t entity, const char* what, const char* topic) {
  if (entity < 0)
    throw std::runtime_error(fmt::format("DDS: {} {}: {}", what, topic, dds_strretcode(-entity)));
  return entity;
}

}  // namespace palpate
