#include "haptic_node/control/answer_watch.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace palpate::haptic {
namespace {

/// A wrench that breaks one promise is not believed, whichever it is.
TEST(AnswerWatch, BelievesNoWrenchThatBreaksAPromise) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ToolWrench sound;
  EXPECT_TRUE(is_sound(sound, 0));
  sound.normal = {0, 0.6, 0.8};
  sound.stretch = -0.02;
  EXPECT_TRUE(is_sound(sound, 0));
  const std::pair<const char*, std::function<void(ToolWrench&)>> wrongs[] = {
      {"other tool", [](ToolWrench& w) { w.tool = 1; }},
      {"NaN force", [=](ToolWrench& w) { w.force[1] = nan; }},
      {"tip beyond reach", [](ToolWrench& w) { w.tip[0] = 1e4; }},
      {"stiffer than rigid", [](ToolWrench& w) { w.stiffness[14] = 2 * rigid_stiffness; }},
      {"attitude of length 2", [](ToolWrench& w) { w.q_WT[0] = 2; }},
      {"normal of length 0.6", [](ToolWrench& w) { w.normal[2] = 0; }},
      {"NaN normal", [=](ToolWrench& w) { w.normal[0] = nan; }},
      {"NaN stretch", [=](ToolWrench& w) { w.stretch = nan; }},
      {"stretched beyond reach", [](ToolWrench& w) { w.stretch = 1e30; }},
  };
  for (const auto& [name, spoil] : wrongs) {
    ToolWrench wrench = sound;
    spoil(wrench);
    EXPECT_FALSE(is_sound(wrench, 0)) << name;
  }
}

}  // namespace
}  // namespace palpate::haptic
