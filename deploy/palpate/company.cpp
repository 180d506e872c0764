#include "deploy/palpate/company.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "common/error/error.h"
#include "common/process/stop_flag.h"
#include "deploy/palpate/nodes.h"

namespace palpate::deploy {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto discovery = std::chrono::milliseconds(1500);  // others announce themselves every second
constexpr auto look_again = std::chrono::milliseconds(20);
constexpr auto leaving = std::chrono::seconds(5);  // a newcomer that does not fit has gone by then

bool among(const std::vector<NodeKind>& nodes, const Identity& one) {
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeKind node) { return name_of(node) == one.role; });
}

bool same_process(const Identity& a, const Identity& b) { return a.pid == b.pid && a.host == b.host; }

bool holds(const std::vector<Identity>& list, const Identity& one) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Identity& other) { return same_process(one, other); });
}

}  // namespace

Company::Company(Participant& participant, std::vector<NodeKind> here, std::vector<NodeKind> elsewhere)
    : companions_(participant),
      own_(participant.identity()),
      here_(std::move(here)),
      elsewhere_(std::move(elsewhere)) {}

/// @param ours_run  nodes of this host with our roles are our own
std::vector<std::string> Company::misfits(bool ours_run) const {
  std::vector<std::string> lines = companions_.differences(!ours_run);
  for (const Identity& other : companions_.present()) {
    if (!among(here_, other) || (ours_run && other.host == own_.host)) continue;
    lines.push_back(fmt::format("{} is in this session already, on {}; choose another --side or --nodes here",
                                other.role, other.host));
  }
  return lines;
}

void Company::require_fitting() {
  const auto end = Clock::now() + discovery;
  while (Clock::now() < end && !stop_requested()) {
    const auto lines = misfits(false);
    if (!lines.empty()) throw InputError(lines);
    std::this_thread::sleep_for(look_again);
  }
  ours_run_ = true;
  fits_since_ = Clock::now();
}

std::vector<std::string> Company::news() {
  std::vector<Identity> nodes;
  for (const Identity& other : companions_.present())
    if (among(elsewhere_, other)) nodes.push_back(other);
  std::vector<std::string> lines;
  for (const Identity& node : nodes)
    if (!holds(nodes_known_, node)) lines.push_back(fmt::format("{} is there, on {}", node.role, node.host));
  for (const Identity& node : nodes_known_) {
    if (!holds(nodes, node))
      lines.push_back(fmt::format("{} on {} has gone; it may come back (Ctrl-C ends)", node.role, node.host));
  }
  nodes_known_ = std::move(nodes);
  return lines;
}

bool Company::has(NodeKind node) const {
  return std::any_of(nodes_known_.begin(), nodes_known_.end(),
                     [&](const Identity& known) { return known.role == name_of(node); });
}

std::vector<std::string> Company::quarrel() {
  const auto lines = misfits(ours_run_);
  if (lines.empty()) fits_since_ = Clock::now();
  if (Clock::now() - fits_since_ < leaving) return {};
  return lines;
}

}  // namespace palpate::deploy
