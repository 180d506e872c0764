#include "deploy/palpate/hand_warnings.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

namespace palpate::deploy {

std::vector<std::string> hand_warnings(const nlohmann::json& summary, Faults faults) {
  constexpr std::array<std::pair<const char*, const char*>, 4> meanings = {{
      {"stale_events",
       "physics was silent for the hand {} time(s), and its force faded until answers came again; look at "
       "the real-time "
       "factor, and between two PCs at the network"},
      {"safe_events",
       "the force went to zero {} time(s): the hand was let go, faster than 1.5 m/s, or its device silent "
       "for 20 ms"},
      {"faults", "a device had {} fault(s); the log says which, and palpate reset TOOL opens it anew"},
      {"watchdog_stops",
       "the hand's loop stood still {} time(s), and the motors were switched off; palpate doctor says what "
       "it lacks"},
  }};
  std::vector<std::string> lines;
  const auto haptic = summary.find("haptic");
  if (haptic == summary.end() || !haptic->is_object()) return lines;
  for (const auto& [key, text] : meanings) {
    if (faults == Faults::named && std::string_view(key) == "faults") continue;
    const auto count = haptic->find(key);
    if (count == haptic->end() || !count->is_number_unsigned()) continue;
    if (const auto n = count->get<std::uint64_t>(); n > 0)
      lines.push_back(fmt::format(fmt::runtime(text), n));
  }
  return lines;
}

}  // namespace palpate::deploy
