#include "render_node/model/hand_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/notices.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

TEST(HandState, IsReadFromTheNoteOfTheHapticNode) {
  const std::string note =
      "no real-time rights; tip: run; finger: ready (inside the tissue, move out); end: fault";
  EXPECT_EQ(hand_state(note, "tip").state, "run");
  EXPECT_EQ(hand_state(note, "tip").reason, "");
  EXPECT_EQ(hand_state(note, "finger").state, "ready");
  EXPECT_EQ(hand_state(note, "finger").reason, "inside the tissue, move out");
  EXPECT_EQ(hand_state(note, "end").state, "fault");
  EXPECT_EQ(hand_state(note, "thumb").state, "");
  EXPECT_EQ(hand_state("x; finger: ready (nobody ho", "finger").reason, "nobody ho")
      << "cut off by its field";
  EXPECT_EQ(hand_state("", "finger").state, "");
}

void hear_note(ViewModel& model, const std::string& note) {
  NodeStatus status;
  status.node = NodeKind::haptic;
  std::copy(note.begin(), note.end(), status.note.begin());
  model.take(status);
}

std::string all_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

TEST(Hindrances, SayWhyThereIsNoForce) {
  const Scene scene = test::small_scene();
  ViewModel model(scene);
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)), "loading: waiting for physics\n");
  NodeStatus loading;
  loading.node = NodeKind::physics;
  loading.phase = NodePhase::loading;
  model.take(loading);
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)), "loading the tissue\n");
  loading.phase = NodePhase::running;
  model.take(loading);
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)), "loading: waiting for its surface\n");
  for (const auto& chunk : test::chunks_of(test::cube_surface(2, 0.1, 0xffffffffU), 0, 1)) model.take(chunk);
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)), "");
  hear_note(model, "rights; finger: ready (inside the tissue, move out)");
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)),
            "finger: no force yet: inside the tissue, move out\n");
  ToolPointer pointer(0, Vec3::Zero());
  EXPECT_EQ(all_of(hindrances(scene, model, true, &pointer)),
            "paused: P goes on\nfinger: click on the tissue to take it\n");
  hear_note(model, "rights; finger: fault");
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)),
            "finger: device fault, no forces; Backspace opens it anew\n");
  hear_note(model, "rights; finger: run");
  EXPECT_EQ(all_of(hindrances(scene, model, false, nullptr)), "");
}

TEST(Hindrances, SayWhenTheHandsPathIsOver) {
  Scene scene = test::small_scene();
  scene.devices[0].waypoints = {{0, Vec3(0, 0, 0.2)}, {2, Vec3(0, 0, 0)}};
  ViewModel model(scene);
  for (const auto& chunk : test::chunks_of(test::cube_surface(2, 0.1, 0xffffffffU), 0, 1)) model.take(chunk);
  const auto over = [&] { return all_of(hindrances(scene, model, false, nullptr)); };
  model.take(test::trace_at({0, 0, 0.2}, 1.0, 0));
  hear_note(model, "rights; finger: armed");
  model.take(test::trace_at({0, 0, 0.2}, 3.5, 0));
  EXPECT_EQ(over(), "") << "the path has not begun";
  hear_note(model, "rights; finger: run");
  model.take(test::trace_at({0, 0, 0.1}, 5.4, 0));
  hear_note(model, "rights; finger: run");
  EXPECT_EQ(over(), "");
  model.take(test::trace_at({0, 0, 0}, 5.6, 0));
  EXPECT_EQ(over(), "the hand's path is over; Esc ends\n");
  Scene by_mouse = scene;
  by_mouse.devices[0].driver = "mouse";
  ViewModel other(by_mouse);
  other.take(test::trace_at({0, 0, 0.2}, 1.0, 0));
  hear_note(other, "rights; finger: run");
  other.take(test::trace_at({0, 0, 0}, 100, 0));
  EXPECT_FALSE(other.path_is_over()) << "a person's hand follows none";
}

}  // namespace
}  // namespace palpate::render
