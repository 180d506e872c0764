// One table for the window, its help and its page.

#include "render_node/ui/bindings.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace palpate::render {
namespace {

TEST(Bindings, GiveNoKeyTwoMeanings) {
  std::set<int> codes;
  for (const Binding& binding : bindings())
    for (const Key& key : binding.codes)
      EXPECT_TRUE(key.code == 0 || codes.insert(key.code).second) << binding.keys;
}

TEST(Bindings, HaveAKeyForEveryAction) {
  for (int i = 1; i < n_actions; ++i)
    EXPECT_NE(binding_of(static_cast<Action>(i)), nullptr) << "action " << i;
  EXPECT_EQ(static_cast<int>(Action::roll_right) + 1, n_actions);
  EXPECT_EQ(binding_of(Action::none), nullptr);
}

TEST(Bindings, KnowTheKeysOfAnAction) {
  HandEvents events;
  events.character('?');
  EXPECT_EQ(presses(events, Action::help), 1);
  EXPECT_EQ(presses(events, Action::close), 0);
  events.key(bindings().front().codes[0].code, true);  // F1
  EXPECT_EQ(presses(events, Action::help), 2);
  EXPECT_TRUE(down(events, Action::help));
  events.forget();
  EXPECT_DOUBLE_EQ(held(events, Action::help, 0.3), 0.3);
  EXPECT_EQ(presses(events, Action::none), 0);
}

/// The rows of the page, word for word and in its order, below the heading of their part.
TEST(Bindings, StandInTheReferenceOfTheWindow) {
  const char* source = std::getenv("PALPATE_SOURCE");
  ASSERT_NE(source, nullptr);
  std::ifstream page(std::string(source) + "/docs/reference/window.md");
  ASSERT_TRUE(page);
  std::vector<std::string> written, wanted;
  bool in_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) written.push_back(line);
    const bool row = line.starts_with("|");
    if (row && in_table && !line.starts_with("|---")) written.push_back(line);
    in_table = row;  // the first line of a table names its columns
  }
  for (const Part part : {Part::window, Part::view, Part::tool}) {
    wanted.push_back(std::string("## ") + heading_of(part));
    for (const Binding& binding : bindings())
      if (binding.part == part)
        wanted.push_back(std::string("| ") + binding.keys + " | " + binding.does + " |");
  }
  EXPECT_EQ(written, wanted);
}

}  // namespace
}  // namespace palpate::render
