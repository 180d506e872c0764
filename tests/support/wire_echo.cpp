// A process that answers every ToolState with a ContactPatch, as physics would, until button 0 is pressed.
// Command line: DOMAIN. Exit code 1 if nobody spoke for ten seconds.

#include <chrono>
#include <cstdlib>

#include "common/wire/reader.h"
#include "common/wire/writer.h"

int main(int argc, char** argv) {
  using namespace palpate;
  if (argc != 2) return 2;
  Participant participant(std::atoi(argv[1]));
  Reader<ToolState> tools(participant);
  Writer<ContactPatch> patches(participant);
  ToolState state;
  ContactPatch patch;
  while (tools.wait(std::chrono::seconds(10))) {
    if (!tools.take_newest(state)) continue;
    if (state.buttons == 1) return 0;
    patch.answers = state.tick;
    patch.answers_ns = state.stamp_ns;
    patches.write(patch);
  }
  return 1;
}
