// docs/reference/scene.md says of every key what the reader does with it: no key less, none more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/scene/device_keys.h"
#include "common/scene/scene.h"
#include "tests/support/reference/page.h"
#include "tests/support/reference/plain_text.h"
#include "tests/unit/common/scene/scene_tables.h"

namespace palpate::test {
namespace {

using Keys = std::set<std::string>;

const std::vector<Section>& page() {
  static const auto sections = reference_page("docs/reference/scene.md");
  return sections;
}

/// Is this row about what the table is of? "sphere, tube", "all"; a section without the column is about one thing only.
bool is_of(const Row& row, const SceneTable& table) {
  const auto column = row.find("of");
  if (column == row.end() || column->second == "all") return true;
  const auto words = ", " + column->second + ",";
  return words.find(", " + table.of + ",") != words.npos;
}

std::vector<Row> rows_of(const SceneTable& table) {
  std::vector<Row> rows;
  const auto is_there = [&](const Row& row) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const Row& other) { return other.at("key") == row.at("key"); });
  };
  for (const auto& row : rows_under(page(), table.heading))
    if (is_of(row, table)) rows.push_back(row);
  if (table.also.empty()) return rows;
  const auto own = rows;
  for (const auto& row : rows_under(page(), table.also))
    if (is_of(row, table) && !is_there(row)) rows.push_back(row);
  return rows;
}

std::string name(const SceneTable& table) {
  return table.heading + (table.of.empty() ? "" : " of " + table.of) + " with\n" + table.keys;
}

/// A table within the file: it has a section of its own.
bool is_table(const Row& row) {
  return row.at("value") == "a table" || row.at("value").find("a table under") != std::string::npos;
}

TEST(SceneReference, HasTheKeysOfTheReaderAndNoOthers) {
  Keys headings;
  for (const auto& table : scene_tables()) {
    headings.insert(table.heading);
    Keys known, written;
    for (const auto& key : known_keys(table)) known.insert(key);
    for (const auto& row : rows_of(table)) written.insert(row.at("key"));
    ASSERT_FALSE(known.empty()) << name(table) << testing::PrintToString(complaints_of(table));
    EXPECT_EQ(written, known) << name(table);
  }
  for (const auto& table : scene_tables())
    for (const auto& row : rows_of(table)) {
      const auto asked = [&](const auto& heading) { return heading.find(row.at("key")) != heading.npos; };
      const bool has_section = std::any_of(headings.begin(), headings.end(), asked);
      EXPECT_TRUE(!is_table(row) || has_section) << row.at("key") << " is a table that nobody asks about";
    }
  for (const auto& section : page())
    EXPECT_TRUE(headings.contains(section.heading) || section.heading == "Options of the drivers")
        << section.heading << " is no table of a scene";
}

TEST(SceneReference, HasTheKeysOfEveryDevice) {
  Keys written;
  for (const auto& row : rows_under(page(), "[device.NAME]"))
    if (row.at("of") == "all") written.insert(row.at("key"));
  EXPECT_EQ(written, Keys(device_keys.begin(), device_keys.end()));
}

TEST(SceneReference, SaysWhatTheReaderTakes) {
  Keys heard, all;
  for (const auto& table : scene_tables())
    for (const auto& row : rows_of(table)) {
      const auto expected = without_backticks(expected_value(table, row.at("key")));
      all.insert(table.heading + " " + row.at("key"));
      if (expected.empty()) continue;
      heard.insert(table.heading + " " + row.at("key"));
      EXPECT_EQ(row.at("value"), expected) << row.at("key") << " in " << name(table);
    }
  EXPECT_EQ(heard, all) << "of some key the reader says nothing";
}

/// Values of all kinds, some of which are right for the key: words that the page names, numbers, lists.
std::vector<std::string> tries_for(const Row& row) {
  std::vector<std::string> tries = {"true",
                                    "false",
                                    "1",
                                    "2",
                                    "7",
                                    "45",
                                    "600",
                                    "1.25",
                                    "0.5",
                                    "0.07",
                                    "1500",
                                    "[1, 2]",
                                    "[640, 480]",
                                    "[0, 0, 0]",
                                    "[4, 5, 6]",
                                    "[4, 5, 6, 60]",
                                    "\"another\"",
                                    "\"n\"",
                                    "\"e\"",
                                    "[[0, 1, 2, 3], [1, 4, 5, 6]]",
                                    "[[0, 1]]",
                                    "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
                                    "{ center_voxel = [1, 2, 3] }",
                                    "[{ material = \"n\", intensity = [0, 1] }]"};
  const auto& value = row.at("value");
  for (auto at = value.find('"'); at != value.npos;) {
    const auto end = value.find('"', at + 1);
    const auto word = value.substr(at, end - at + 1);
    tries.push_back(word);
    tries.push_back("[" + word + "]");
    at = value.find('"', end + 1);
  }
  return tries;
}

/// A key does something: with one of its values the scene is another one. @return where, with what was there before
Lines changed_by(const SceneTable& table, const Row& row) {
  const auto before = scene_of_table(table.without(row.at("key")));
  const auto plain = before ? lines_of(*before) : Lines{};
  if (!before) return {};
  for (const auto& value : tries_for(row)) {
    const auto scene = scene_of_table(table.with(row.at("key"), value));
    if (!scene) continue;
    Lines changed;
    for (const auto& [path, now] : lines_of(*scene)) {
      const auto then = plain.find(path);
      if (then == plain.end() || then->second != now)
        changed[path] = then == plain.end() ? "none" : then->second;
    }
    if (!changed.empty()) return changed;
  }
  return {};
}

bool is_missed(const SceneTable& table, const std::string& key) {
  for (const auto& line : complaints_of(table.without(key)))
    if (line.find(" lacks ") != line.npos && line.find(key) != line.npos) return true;
  return false;
}

TEST(SceneReference, SaysWhatIsRequired) {
  Keys shown, all;
  for (const auto& table : scene_tables()) {
    ASSERT_EQ(complaints_of(table), std::vector<std::string>{}) << name(table);
    for (const auto& row : rows_of(table)) {
      const auto& key = row.at("key");
      const bool required = row.at("default").starts_with("required");
      if (required && !is_table(row)) all.insert(table.heading + " " + key);
      if (table.without(key).keys == table.keys) continue;
      EXPECT_EQ(required, is_missed(table, key)) << key << " in " << name(table);
      if (required) shown.insert(table.heading + " " + key);
    }
  }
  EXPECT_EQ(shown, all) << "some key is required in no table";
}

TEST(SceneReference, SaysTheDefaults) {
  Keys shown, all;  // every key changes the scene, every default is tried
  for (auto table : scene_tables()) {
    table.also.clear();  // those are tried in tables of their own
    for (const auto& row : rows_of(table)) {
      const auto &key = row.at("key"), &standing = row.at("default"), &value = row.at("value");
      if (is_table(row) || standing.starts_with("required")) continue;
      const auto what = table.heading + " " + key + (row.contains("of") ? " of " + row.at("of") : "");
      all.insert(what);
      const bool used = table.without(key).keys != table.keys;
      if (used) shown.insert(what);
      const auto plain = scene_of_table(table.without(key));
      if (!plain) continue;
      const auto changed = changed_by(table, row);
      const bool one_word = value.starts_with("\"auto\"");
      if (!changed.empty() || one_word) shown.insert(what);
      if (standing.starts_with("none")) {
        const bool is_word = value.starts_with("\"");  // else a key may change of what kind the whole is
        for (const auto& [path, before] : changed) {
          if (path.ends_with("#") || (!is_word && before.starts_with("word"))) continue;
          EXPECT_EQ(before, "none") << path << ": " << key << " has a default in " << name(table);
        }
        continue;
      }
      all.insert(what + ", its default");
      const auto given = scene_of_table(table.with(key, standing));
      if (!given) continue;
      shown.insert(what + ", its default");
      EXPECT_EQ(lines_of(*given), lines_of(*plain)) << key << " = " << standing << " in " << name(table);
    }
  }
  for (const auto& what : all) EXPECT_TRUE(shown.contains(what)) << what << " is not shown by any table";
}

TEST(SceneReference, SaysTheUnitThatTheNameOfAKeyEndsWith) {
  const std::vector<std::pair<std::string, std::string>> units = {{"_N_m_s_per_rad", "N m s/rad"},
                                                                  {"_N_m_per_rad", "N m/rad"},
                                                                  {"_kg_per_m3", "kg/m^3"},
                                                                  {"_N_s_per_m", "N s/m"},
                                                                  {"_N_per_m", "N/m"},
                                                                  {"_m_per_s2", "m/s^2"},
                                                                  {"_m_per_s", "m/s"},
                                                                  {"_kg_m2", "kg m^2"},
                                                                  {"_Pa_s", "Pa s"},
                                                                  {"_N_m", "N m"},
                                                                  {"_N", "N"},
                                                                  {"_kPa", "kPa"},
                                                                  {"_mm", "mm"},
                                                                  {"_ms", "ms"},
                                                                  {"_deg", "deg"},
                                                                  {"_Hz", "Hz"},
                                                                  {"_MB", "MB"},
                                                                  {"_px", "px"},
                                                                  {"_g", "g"}};
  for (const auto& section : page())
    for (const auto& row : section.rows) {
      if (!row.contains("unit")) continue;
      const auto unit = std::find_if(units.begin(), units.end(),
                                     [&](const auto& u) { return row.at("key").ends_with(u.first); });
      const auto wanted = unit == units.end() ? "" : unit->second;  // "s, deg": of numbers of several kinds
      EXPECT_TRUE(row.at("unit").ends_with(wanted))
          << section.heading << " " << row.at("key") << ": " << wanted;
    }
}

TEST(SceneReference, MeansSomethingByEveryKey) {
  for (const auto& section : page())
    for (const auto& row : section.rows)
      EXPECT_NE(row.at("meaning"), "") << section.heading << " " << testing::PrintToString(row);
}

}  // namespace
}  // namespace palpate::test
