// Ends of a wire, as nodes have them: each uses shared memory where a node would. Command line: WHAT DOMAIN
//   echo    answers ToolStates until button 0 is pressed; has said a status and a surface of 40 chunks before
//   talk    asks the echo 300 times, hears what it said before, and presses the button
//   paint   writes 100 rounds of 200 vertex blocks to one watcher
//   watch   looks at them every 0.2 s until all are of the last round
// The last line of the output says in "name=number" what came of it.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <string_view>
#include <thread>

#include "common/wire/reader.h"
#include "common/wire/writer.h"

namespace {

using namespace palpate;
using namespace std::chrono_literals;

constexpr std::uint32_t n_chunks = 40;
constexpr std::uint32_t n_blocks = 200;
constexpr std::uint64_t n_rounds = 100;
constexpr int n_questions = 300;

template <class Done>
bool eventually(Done done) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

int echo(Participant& participant) {
  Reader<ToolState> tools(participant);
  Writer<ContactPatch> patches(participant);
  Writer<NodeStatus> statuses(participant);
  Writer<BodySurface> surfaces(participant);
  statuses.write(NodeStatus{});
  const auto chunk = std::make_unique<BodySurface>();
  chunk->revision = 1;
  chunk->n_chunks = n_chunks;
  for (chunk->chunk = 0; chunk->chunk < n_chunks; ++chunk->chunk) surfaces.write(*chunk);
  ToolState state;
  ContactPatch patch;
  while (tools.wait(20s)) {
    if (!tools.take_newest(state)) continue;
    if (state.buttons == 1) return 0;
    patch.answers = state.tick;
    patches.write(patch);
  }
  return 1;
}

int talk(Participant& participant) {
  Writer<ToolState> tools(participant);
  Reader<ContactPatch> patches(participant);
  Reader<NodeStatus> statuses(participant);
  Reader<BodySurface> surfaces(participant);
  if (!eventually([&] { return tools.matched() == 1 && patches.matched() == 1; })) return 1;
  ToolState state;
  ContactPatch patch;
  int answered = 0;
  for (state.tick = 1; state.tick <= n_questions; ++state.tick) {
    tools.write(state);
    answered += patches.wait(100ms) && patches.take_newest(patch) && patch.answers == state.tick ? 1 : 0;
  }
  NodeStatus status;
  const bool heard = eventually([&] { return statuses.take(status); });
  const auto chunk = std::make_unique<BodySurface>();
  std::set<std::uint32_t> chunks;
  eventually([&] {
    while (surfaces.take(*chunk)) chunks.insert(chunk->chunk);
    return chunks.size() == n_chunks;
  });
  state.buttons = 1;
  eventually([&] { return tools.write(state), tools.matched() == 0; });
  std::printf("shared=%d answered=%d status=%d chunks=%zu\n", participant.shared_memory(), answered, heard,
              chunks.size());
  return 0;
}

int paint(Participant& participant) {
  Writer<VertexBlock> blocks(participant);
  if (!eventually([&] { return blocks.matched() == 1; })) return 1;
  std::this_thread::sleep_for(200ms);
  const auto block = std::make_unique<VertexBlock>();
  block->revision = 1;
  block->n_vertices = max_block_vertices;
  int refused = 0;
  for (block->tick = 1; block->tick <= n_rounds; ++block->tick) {
    for (block->block = 0; block->block < n_blocks; ++block->block) {
      block->first_vertex = block->block * max_block_vertices;
      refused += blocks.write(*block) ? 0 : 1;
    }
    std::this_thread::sleep_for(5ms);
  }
  std::printf("shared=%d refused=%d\n", participant.shared_memory(), refused);
  return 0;
}

int watch(Participant& participant) {
  Reader<VertexBlock> blocks(participant);
  const auto block = std::make_unique<VertexBlock>();
  std::set<std::uint32_t> newest;
  eventually([&] {
    while (blocks.take(*block))
      if (block->tick == n_rounds) newest.insert(block->block);
    std::this_thread::sleep_for(200ms);
    return newest.size() == n_blocks;
  });
  std::printf("shared=%d newest=%zu\n", participant.shared_memory(), newest.size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  palpate::Membership membership;
  membership.domain = std::atoi(argv[2]);
  membership.shared_memory = true;
  palpate::Participant participant(membership);
  const std::string_view what = argv[1];
  if (what == "echo") return echo(participant);
  if (what == "talk") return talk(participant);
  if (what == "paint") return paint(participant);
  if (what == "watch") return watch(participant);
  return 2;
}
