#pragma once
// Every table of a scene file in a small scene that is right, so that a test can ask the reader about each of its keys.

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace palpate::test {

/// A scene with the place of one table's keys marked.
struct SceneTable {
  std::string heading;  // of docs/reference/scene.md, where its keys stand
  std::string of;       // what the column "of" calls it; empty where the section has no such column
  std::string before, keys, after;  // text of the scene: around the table's lines, and those lines
  std::string also = "";  // another heading, for the keys that are not under the first; its "of" is the same

  /// Without the line of a key.
  SceneTable without(const std::string& key) const;
  /// With one line more, in place of the one for the same key.
  SceneTable with(const std::string& key, const std::string& value) const;
  std::string text() const { return before + keys + after; }
};

const std::vector<SceneTable>& scene_tables();

/// The reader's complaints without their places.
std::vector<std::string> complaints_of(const SceneTable& table);

/// The scene, if it is right.
std::optional<Scene> scene_of_table(const SceneTable& table);

/// The keys that the reader knows in this table, from what it says of a key that it does not know.
std::vector<std::string> known_keys(const SceneTable& table);

/// What the reader says should be written, of the whole value and then of each of its numbers; empty: nothing to be heard.
std::string expected_value(const SceneTable& table, const std::string& key);

}  // namespace palpate::test
