#pragma once
// All topics of palpate-physics in one place.

#include <chrono>

#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/speaker.h"
#include "common/wire/writer.h"
#include "physics_node/loop/eye_sender.h"

namespace palpate::physics {

struct Wire {
  explicit Wire(const Membership& membership)
      : participant(membership), eye(participant, !membership.reach.local()) {}
  Participant participant;
  // As long as a hand's force counts: after that another hand may take over, on this PC or another.
  static constexpr std::chrono::milliseconds hand_silence{50};
  Speaker hand{participant, "haptic", hand_silence};
  Speaker people{participant, {"render", "supervisor"}};
  Reader<ToolState> tool_states{participant, &hand};
  Reader<Command> commands{participant, &people};
  Writer<ContactPatch> patches{participant};
  Writer<ToolWrench> wrenches{participant};
  Writer<NodeStatus> status{participant};
  EyeSender eye;
};

}  // namespace palpate::physics
