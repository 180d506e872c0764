#pragma once
// All topics of palpate-physics in one place.

#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/speaker.h"
#include "common/wire/writer.h"
#include "physics_node/loop/eye_sender.h"
#include "physics_node/loop/hands.h"

namespace palpate::physics {

struct Wire {
  explicit Wire(const Membership& membership)
      : participant(membership), eye(participant, !membership.reach.local()) {}
  Participant participant;
  Speaker hand{participant, "haptic", Hands::silence};
  Speaker people{participant, {"render", "supervisor"}};
  Reader<ToolState> tool_states{participant, &hand};
  Reader<Command> commands{participant, &people};
  Writer<ContactPatch> patches{participant};
  Writer<ToolWrench> wrenches{participant};
  Writer<NodeStatus> status{participant};
  EyeSender eye;
};

}  // namespace palpate::physics
