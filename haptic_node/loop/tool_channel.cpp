#include "haptic_node/loop/tool_channel.h"

#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/time/clock.h"

namespace palpate::haptic {

std::unique_ptr<HapticSession> open_session(const Scene& scene, std::uint32_t tool, const std::string& driver,
                                            int domain) {
  return std::make_unique<HapticSession>(
      scene, tool, driver, [](void*) { return now_ns(); }, nullptr, HapticSession::Power::by_service, domain);
}

ToolChannel::ToolChannel(const Scene& scene, std::uint32_t tool, const std::string& driver, int domain)
    : name(scene.tools[tool].name),
      session(open_session(scene, tool, driver, domain)),
      flight(session.get()->rate_Hz()) {}

}  // namespace palpate::haptic
