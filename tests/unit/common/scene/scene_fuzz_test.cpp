// Whatever the bytes: a Scene or an InputError, never anything else.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string_view>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

/// A few random edits: bytes changed, cut, doubled, or replaced by a piece that parsers like to stumble over.
std::string mutated(std::string text, std::mt19937_64& random) {
  constexpr std::array<std::string_view, 24> pieces = {
      "[",        "]",     "{",  "}",   "=",    "\"",  "\"\"\"",     "'''",
      "\n",       "1e999", "-0", "nan", "inf",  "[[]", "[[body]]\n", "0x",
      "\xff\xfe", "\\u0",  "#",  ".",   "a.b=", "{}",  "[[[[[",      "9999999999999999999"};
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); };
  if (below(4) == 0) {  // a gentle one: another digit
    const auto digit = text.find_first_of("0123456789", below(text.size()));
    if (digit != text.npos) text[digit] = static_cast<char>('0' + below(10));
    return text;
  }
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const auto at = below(text.size());
    const auto length = 1 + below(30);
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 3:
        text.insert(at, pieces[below(pieces.size())]);
        break;
      default:
        text.replace(at, length, pieces[below(pieces.size())]);
        break;
    }
    if (text.empty()) text = " ";
  }
  return text;
}

TEST(SceneReader, AnswersAnyMutationWithASceneOrAComplaint) {
  std::mt19937_64 random(20261121);
  int right = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto text = mutated(i % 2 == 0 ? test::full_scene : test::least_scene, random);
    try {
      const auto scene = parse_scene(text, test::scene_folder() + "/s.toml");
      ASSERT_FALSE(scene.bodies.empty()) << text;
      for (const auto& body : scene.bodies) ASSERT_NO_FATAL_FAILURE(scene.material(body.material));
      ++right;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.complaints().empty()) << text;
      for (const auto& line : error.complaints()) ASSERT_EQ(line.find('\n'), line.npos) << line;
      ++wrong;
    }
  }
  EXPECT_GT(right, 1000) << "mutations are too wild to reach the readers";
  EXPECT_GT(wrong, 10000);
}

TEST(SceneReader, AnswersRandomSettingsWithASceneOrAComplaint) {
  std::mt19937_64 random(7);
  const std::array<std::string, 5> settings = {"physics.threads=2", "body.ball.at_mm=[0,0,0]",
                                               "render.camera.yaw_deg=1", "title=word",
                                               "device.left.port=\"x\""};
  for (int i = 0; i < 5000; ++i) {
    const auto setting = mutated(settings[static_cast<std::size_t>(i) % settings.size()], random);
    try {
      parse_scene(test::full_scene, test::scene_folder() + "/s.toml", {setting});
    } catch (const InputError& error) {
      ASSERT_FALSE(error.complaints().empty()) << setting;
    }
  }
}

}  // namespace
}  // namespace palpate
