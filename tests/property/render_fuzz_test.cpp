// What the eye makes of a hundred thousand messages of each kind that it hears: as they should be, and with words and numbers
// replaced, through the wire's door into the picture that is drawn. Nothing is read beyond an array (sanitizers watch),
// nothing drawn is not finite, and what is kept stays within its budget.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "common/wire/convert.h"
#include "common/wire/topic.h"
#include "render_node/frame_schedule.h"
#include "render_node/model/view_model.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate::render {
namespace {

using palpate::test::Dice;

Scene small_scene() {
  Scene scene;
  scene.bodies.resize(2);
  scene.devices.resize(1);
  scene.devices[0].name = "hand";
  scene.tools.resize(2);
  for (ToolSpec& tool : scene.tools) tool.device = "hand";
  return scene;
}

template <class Wire>
void spoil(Dice& dice, Wire& wire) {
  constexpr std::array<double, 8> numbers = {1e300, 1e17, -1e308, 1e8, -1e3, 1e-310, HUGE_VAL, NAN};
  auto* bytes = reinterpret_cast<unsigned char*>(&wire);
  constexpr std::uint32_t size = sizeof(Wire);
  for (std::uint32_t n = 1 + dice.below(3); n > 0; --n) {
    const std::uint32_t within = dice.below(2) == 0 ? std::min(size, 256U) : size;
    const double number = numbers[dice.below(numbers.size())];
    const auto word = static_cast<std::uint32_t>(dice.below(2) == 0 ? dice.integer() : dice.below(70));
    if (dice.below(2) == 0)
      std::memcpy(bytes + 8 * dice.below(within / 8), &number, sizeof number);
    else
      std::memcpy(bytes + 4 * dice.below(within / 4), &word, sizeof word);
  }
  wire.version = wire_version;
}

/// About a body that is there; half of the surfaces are whole with one chunk.
void aim(Dice& dice, BodySurface& m) {
  m.body = dice.below(2);
  m.revision = 1 + dice.below(1'000'000);
  if (dice.below(2) == 0) return;
  m.n_chunks = 1;
  m.chunk = m.first_vertex = m.first_facet = 0;
  m.total_vertices = m.n_vertices;
  m.total_facets = m.n_facets;
  for (std::uint32_t i = 0; i < m.n_facets; ++i)
    for (std::uint32_t& corner : m.corners[i]) corner %= m.n_vertices;
}
/// About a body that is there; half of them are whole with one page.
void aim(Dice& dice, SurfaceChange& m) {
  m.body = dice.below(2);
  m.revision = 1 + static_cast<std::uint32_t>(dice.integer() % 1'000'000);
  if (dice.below(2) == 0) test::make_whole(m);
}
void aim(Dice& dice, VertexBlock& m) {
  m.body = dice.below(2);
  m.revision = 1 + dice.below(1'000'000);
  m.block = dice.below(4);
  m.first_vertex = m.block * max_block_vertices;
}
template <class M>
void aim(Dice& dice, M& m) {
  if constexpr (requires { m.tool; }) m.tool = dice.below(2);
}

template <class M>
class AnyMessage : public testing::Test {};
using Seen = testing::Types<BodySurface, SurfaceChange, VertexBlock, ToolWrench, HapticTrace, NodeStatus>;
TYPED_TEST_SUITE(AnyMessage, Seen);

TYPED_TEST(AnyMessage, LeavesThePictureFiniteAndSmall) {
  using M = TypeParam;
  ViewModel model(small_scene());
  FrameSchedule schedule(30);
  Dice dice(20261122);
  const auto message = std::make_unique<M>();
  const auto wire = std::make_unique<typename Topic<M>::Wire>();
  // A large message is drawn once and spoiled many times, since drawing it takes most of the time.
  int accepted = 0;
  for (int i = 0; i < 100'000; ++i) {
    if (i % 10 == 0) {
      randomise(dice, *message);
      aim(dice, *message);
      to_wire(*message, *wire);
    }
    if (i % 10 > 0) spoil(dice, *wire);
    if constexpr (requires { wire->revision; }) wire->revision += 1;
    if (from_wire(*wire, *message)) continue;
    ++accepted;
    model.take(*message);
    if (accepted % 100 > 0) continue;
    model.refresh();
    schedule.due(model.t());
    ASSERT_TRUE(std::isfinite(model.t()));
    for (const ToolView& tool : model.tools()) {
      ASSERT_TRUE(std::isfinite(tool.on_tool.peak()) && std::isfinite(tool.on_hand.peak()));
      ASSERT_LE(tool.on_tool.points().size(), 1002U);
      ASSERT_LE(tool.on_hand.points().size(), 1002U);
    }
    for (const BodyPicture& body : model.bodies()) ASSERT_TRUE(std::isfinite(body.edge_length()));
    ASSERT_LE(model.memory_used(), MemoryBudget::most);
  }
  EXPECT_GT(accepted, 10'000) << "the messages hardly reach the picture";
}

}  // namespace
}  // namespace palpate::render
