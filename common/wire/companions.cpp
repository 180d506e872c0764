#include "common/wire/companions.h"

#include <dds/dds.h>

#include <array>
#include <utility>

#include "common/wire/topic.h"

namespace palpate {
namespace {

constexpr std::size_t at_once = 64;

std::optional<Identity> identity_of(const dds_builtintopic_participant_t& participant) {
  void* data = nullptr;
  std::size_t size = 0;
  if (participant.qos == nullptr || !dds_qget_userdata(participant.qos, &data, &size) || data == nullptr)
    return {};
  auto identity = identity_from({static_cast<const char*>(data), size});
  dds_free(data);
  return identity;
}

}  // namespace

Companions::Companions(Participant& participant) : Companions(participant, participant.identity()) {}

Companions::Companions(Participant& participant, Identity own) : own_(std::move(own)) {
  reader_ = made(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr),
                 "reader of", "participants");
}

Companions::~Companions() { dds_delete(reader_); }

std::vector<Identity> Companions::present() const {
  std::vector<Identity> found;
  std::array<void*, at_once> samples = {};
  std::array<dds_sample_info_t, at_once> infos = {};
  const int n = dds_read_mask(reader_, samples.data(), infos.data(), at_once, at_once,
                              DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!infos[at].valid_data) continue;
    const auto identity = identity_of(*static_cast<dds_builtintopic_participant_t*>(samples[at]));
    if (!identity || (identity->pid == own_.pid && identity->host == own_.host)) continue;
    found.push_back(*identity);
  }
  if (n > 0) dds_return_loan(reader_, samples.data(), n);
  return found;
}

std::vector<std::string> Companions::differences(bool with_supervisors) const {
  std::vector<std::string> lines;
  for (const Identity& other : present()) {
    if (other.role == "supervisor" && !with_supervisors) continue;
    const std::string line = difference(own_, other);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::vector<Identity> Companions::doubles() const {
  if (own_.role != "physics" && own_.role != "haptic") return {};
  std::vector<Identity> found = present();
  std::erase_if(found, [this](const Identity& other) { return other.role != own_.role; });
  return found;
}

}  // namespace palpate
