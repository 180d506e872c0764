#include "common/wire/speaker.h"

#include <dds/dds.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "common/process/other_process.h"
#include "common/time/clock.h"

namespace palpate {
namespace {

// Who is not heard is looked at again only where the one who is heard has been silent for a while, and not with each sample:
// what passes may take the place of a sample that was not read yet.
constexpr std::int64_t look_again_ns = 50'000'000;
constexpr int most_remarks = 100;

using Endpoint = std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>;

std::optional<Identity> identity_of(const dds_builtintopic_endpoint_t& writer) {
  void* data = nullptr;
  std::size_t size = 0;
  if (writer.qos == nullptr || !dds_qget_userdata(writer.qos, &data, &size) || data == nullptr) return {};
  auto identity = identity_from({static_cast<const char*>(data), size});
  dds_free(data);
  return identity;
}

std::string name_of(const std::optional<Identity>& identity) {
  if (!identity) return "a process that does not say who it is";
  return fmt::format("{} on {} (pid {})", identity->role, identity->host, identity->pid);
}

}  // namespace

Speaker::Speaker(const Participant& participant, const std::string& role, std::chrono::nanoseconds patience)
    : own_(participant.identity()), roles_{role}, patience_ns_(patience.count()) {}

Speaker::Speaker(const Participant& participant, std::vector<std::string> roles)
    : own_(participant.identity()), roles_(std::move(roles)), patience_ns_(0) {}

std::int64_t Speaker::silence_ns() const noexcept {
  return now_ns() - heard_ns_.load(std::memory_order_relaxed);
}

bool Speaker::is_foreign(std::uint64_t publication) const noexcept {
  return std::any_of(foreign_.begin(), foreign_.end(),
                     [&](const auto& one) { return one.load(std::memory_order_relaxed) == publication; });
}

bool Speaker::may_pass(std::uint64_t publication) noexcept {
  const std::int64_t now = now_ns();
  if (!is_foreign(publication)) {
    came_ns_.store(now, std::memory_order_relaxed);
    return true;
  }
  if (patience_ns_ == 0 || now - came_ns_.load(std::memory_order_relaxed) < look_again_ns) return false;
  std::int64_t looked = looked_ns_.load(std::memory_order_relaxed);
  return now - looked >= look_again_ns && looked_ns_.compare_exchange_strong(looked, now);
}

bool Speaker::admits(std::int32_t reader, const char* topic, std::uint64_t publication) {
  Known* who = find(reader, publication);
  if (who != nullptr && may_speak(*who)) {
    heard_ns_.store(now_ns(), std::memory_order_relaxed);
    return true;
  }
  refuse(who, topic, publication);
  return false;
}

/// @return null: its writer has gone, and was never heard before
Speaker::Known* Speaker::find(std::int32_t reader, std::uint64_t publication) {
  const auto at = std::find_if(known_.begin(), known_.end(),
                               [&](const Known& one) { return one.publication == publication; });
  if (at != known_.end()) return &*at;
  const Endpoint writer(dds_get_matched_publication_data(reader, publication),
                        &dds_builtintopic_free_endpoint);
  // Many may speak, and one that said its word and went did: its word counts as that of somebody unnamed.
  if (!writer && patience_ns_ > 0) return nullptr;
  Known& one = known_[next_known_++ % most_known];
  one = {};
  one.publication = publication;
  if (!writer) return &one;
  std::memcpy(one.process.data(), writer->participant_key.v, one.process.size());
  one.identity = identity_of(*writer);
  one.rank = rank_of(one.identity);
  return &one;
}

Speaker::Rank Speaker::rank_of(const std::optional<Identity>& identity) const {
  if (!identity) return Rank::unnamed;
  if (std::find(roles_.begin(), roles_.end(), identity->role) == roles_.end()) return Rank::stranger;
  // Who is nobody in particular has no scene of his own to compare with.
  return own_.role.empty() || difference(own_, *identity).empty() ? Rank::member : Rank::stranger;
}

bool Speaker::may_speak(const Known& who) {
  if (who.rank == Rank::stranger) return false;
  if (patience_ns_ == 0) return true;
  if (current_ && who.process == current_->process) return true;
  if (current_) {
    const auto& before = current_->identity;
    const bool silent = silence_ns() > patience_ns_;
    const bool ended = before && before->host == own_.host && has_ended(before->pid);
    if (who.rank <= current_->rank && !silent && !ended) return false;
    remark(fmt::format("{} speaks as {} from now on: {} {}", name_of(who.identity), roles_.front(),
                       name_of(before),
                       ended    ? "has ended"
                       : silent ? "is silent"
                                : "comes after it"));
  }
  current_ = who;
  for (auto& one : foreign_) one.store(0, std::memory_order_relaxed);
  changes_.fetch_add(1, std::memory_order_release);
  return true;
}

void Speaker::refuse(Known* who, const char* topic, std::uint64_t publication) {
  if (!is_foreign(publication))
    foreign_[next_foreign_++ % most_known].store(publication, std::memory_order_relaxed);
  if (who == nullptr || who->told) return;
  who->told = true;
  std::string why;
  if (who->rank != Rank::stranger)
    why = fmt::format("{} speaks here", name_of(current_->identity));
  else if (std::find(roles_.begin(), roles_.end(), who->identity->role) == roles_.end())
    why = fmt::format("only {} may speak here", fmt::join(roles_, " or "));
  else
    why = difference(own_, *who->identity);
  why_not_ = fmt::format("{} of {} is not heard: {}", topic, name_of(who->identity), why);
  remark(why_not_);
}

void Speaker::remark(std::string line) {
  const std::lock_guard lock(mutex_);
  if (++n_remarks_ <= most_remarks) remarks_.push_back(std::move(line));
}

std::vector<std::string> Speaker::remarks() {
  const std::lock_guard lock(mutex_);
  return std::exchange(remarks_, {});
}

}  // namespace palpate
