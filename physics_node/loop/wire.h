#pragma once
// All topics of palpate-physics in one place.

#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"

namespace palpate::physics {

struct Wire {
  explicit Wire(int domain) : participant(domain) {}
  Participant participant;
  Reader<ToolState> tool_states{participant};
  Reader<Command> commands{participant};
  Writer<ContactPatch> patches{participant};
  Writer<ToolWrench> wrenches{participant};
  Writer<BodySurface> surfaces{participant};
  Writer<VertexBlock> blocks{participant};
  Writer<NodeStatus> status{participant};
};

}  // namespace palpate::physics
