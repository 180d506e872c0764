#include "common/wire/participant.h"

#include <dds/dds.h>
#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>

#include "common/error/error.h"
#include "common/report/log.h"
#include "common/time/clock.h"
#include "common/wire/loopback_config.h"
#include "common/wire/loopback_sockets.h"
#include "common/wire/network_config.h"
#include "common/wire/shared_memory.h"
#include "common/wire/socket_filter.h"
#include "common/wire/topic.h"

namespace palpate {
namespace {

constexpr std::int64_t log_period_ns = 1'000'000'000;
constexpr int most_log_lines = 5;  // in a period: whoever sends rubbish shall not fill a disk

/// @return true if DDS may say one more line now; says at the next one how many were left out
bool may_log() {
  static std::mutex mutex;
  static std::int64_t period = 0;
  static int lines = 0;
  const std::lock_guard lock(mutex);
  if (const std::int64_t now = now_ns() / log_period_ns; now != period) {
    if (lines > most_log_lines) log_warn("dds: {} more lines like these", lines - most_log_lines);
    period = now;
    lines = 0;
  }
  return ++lines <= most_log_lines;
}

/// What Cyclone DDS itself has to say becomes a line of our log.
void pass_on(void*, const dds_log_data_t* data) {
  if (!may_log()) return;
  std::string_view text(data->message + data->hdrsize, data->size - data->hdrsize);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
  log_line((data->priority & (DDS_LC_ERROR | DDS_LC_FATAL)) != 0 ? LogLevel::error : LogLevel::warn,
           fmt::format("dds: {}", text));
}

bool environment_configures() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri != nullptr && *uri != '\0';
}

}  // namespace

/// One per domain and process: the configuration, which ends with the last participant.
/// Why: a driver is a library with a copy of this code, so that a process may hold several of these for one domain. The
/// first makes the domain, the others join it, and the one that goes last takes it away.
struct Participant::Domain {
  explicit Domain(int the_id) : id(static_cast<dds_domainid_t>(the_id)) {}
  dds_domainid_t id;
  dds_entity_t entity = 0;  // 0: made by DDS from the environment
  bool joined = false;      // another copy of this code has made it
  bool built_in = false;
  bool shared_memory = false;
  Route route;  // where built_in
  std::atomic<bool> local_only{false};
  ~Domain() {
    if (entity > 0 && dds_lookup_participant(id, nullptr, 0) <= 0) dds_delete(entity);
  }
};

std::shared_ptr<Participant::Domain> Participant::join(const Membership& membership,
                                                       const std::string& config) {
  const int domain = membership.domain;
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Domain>> known;
  const std::lock_guard lock(mutex);
  if (auto shared = known[domain].lock()) return shared;

  auto shared = std::make_shared<Domain>(domain);
  const auto make = [&](const std::string& text) {
    shared->entity = dds_create_domain(shared->id, text.c_str());
    shared->joined = shared->entity == DDS_RETCODE_PRECONDITION_NOT_MET;
    if (!shared->joined) dds_set_log_sink(&pass_on, nullptr);
    return shared->joined || shared->entity > 0;
  };
  if (!config.empty()) {
    if (!std::filesystem::is_regular_file(config)) {
      throw InputError(
          fmt::format("{}: no such DDS configuration; see deploy/cyclonedds for samples", config));
    }
    if (!make("file://" + config))
      throw InputError(fmt::format("{}: is not a Cyclone DDS configuration", config));
  } else if (!environment_configures()) {
    shared->built_in = true;
    shared->route = resolve(membership.reach);
    const bool local = membership.reach.local();
    // Why asked again where the domain is joined: whoever made it looked as we do, and readers must fit it.
    shared->shared_memory = membership.shared_memory && local && look_for_roudi() == RouDi::ready;
    if (shared->shared_memory) tame_iceoryx_errors();
    const std::string text = !local                  ? network_config(shared->route)
                             : shared->shared_memory ? with_shared_memory(loopback_config())
                                                     : std::string(loopback_config());
    if (!make(text)) {
      throw std::runtime_error(
          fmt::format("DDS domain {} cannot be set up ({})", domain, dds_strretcode(-shared->entity)));
    }
  } else if (!membership.reach.local()) {
    throw InputError(
        "CYCLONEDDS_URI is set and would replace --interface and --peers; unset it, or leave the options "
        "out");
  } else {
    dds_set_log_sink(&pass_on, nullptr);
  }
  known[domain] = shared;
  return shared;
}

Participant::Participant(int domain, const std::string& config)
    : Participant(Membership{domain, {}, {}}, config) {}

Participant::Participant(const Membership& membership) : Participant(membership, "") {}

Participant::Participant(const Membership& membership, const std::string& config)
    : domain_(membership.domain), identity_(membership.identity) {
  if (domain_ < 0 || domain_ > 100)
    throw InputError(fmt::format("DDS domain {}: give a number from 0 to 100", domain_));
  shared_ = join(membership, config);
  const Qos qos(dds_create_qos(), &dds_delete_qos);
  if (!identity_.role.empty()) {
    const std::string text = to_text(identity_);
    dds_qset_userdata(qos.get(), text.data(), text.size());
  }
  handle_ = dds_create_participant(static_cast<dds_domainid_t>(domain_), qos.get(), nullptr);
  if (handle_ < 0) {
    throw std::runtime_error(fmt::format(
        "DDS domain {} cannot be joined ({}); is another session there? Give another domain with --domain",
        domain_, dds_strretcode(-handle_)));
  }
  if (shared_->joined && shared_->entity <= 0) shared_->entity = dds_get_parent(handle_);
  if (!shared_->built_in) return;
  // Who made the domain has closed its doors, for whatever reach the session has.
  if (shared_->joined)
    shared_->local_only = hears_loopback_only(domain_);
  else
    close_doors(*shared_, membership.reach);
}

void Participant::close_doors(Domain& shared, const Reach& reach) const {
  if (!reach.local()) {
    if (!hear_only(domain_, shared.route))
      log_warn("DDS hears more than was asked for: the kernel refused to filter its sockets");
    return;
  }
  shared.local_only = tie_to_loopback(domain_);
  if (!shared.local_only)
    log_warn("DDS listens beyond this machine: the kernel refused to tie it to loopback");
}

Participant::~Participant() { dds_delete(handle_); }

bool Participant::local_only() const noexcept { return shared_->local_only; }
bool Participant::shared_memory() const noexcept { return shared_->shared_memory; }

}  // namespace palpate
