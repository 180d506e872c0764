#include "common/scene/apply_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "common/error/error.h"
#include "common/scene/device_keys.h"
#include "common/scene/near_miss.h"
#include "common/scene/table_reader.h"
#include "common/scene/toml_text.h"

namespace palpate {
namespace {

/// What a setting goes wrong with; caught in apply_settings only.
struct BadSetting {
  std::string what;
};

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> words(1);
  for (const char c : path) {
    if (c == '.')
      words.emplace_back();
    else
      words.back() += c;
  }
  for (const auto& word : words)
    if (!is_name(word)) throw BadSetting{"\"" + path + "\" is no path; write table.key=value"};
  return words;
}

/// The one value of a text in TOML, placed at `name`; nothing if it is not TOML or more than one value.
std::optional<toml::table> parsed_value(const std::string& text, const std::string& name) {
  try {
    auto table = table_of_text("value = " + text, name);
    if (table.size() == 1) return table;
  } catch (const InputError&) {  // perhaps a bare word
  }
  return std::nullopt;
}

/// A table { value = ... }. A text that is no TOML and has no sign of being meant as such is a string.
toml::table value_of(const std::string& text, const std::string& name) {
  if (auto table = parsed_value(text, name)) return std::move(*table);
  if (!text.empty() && text.find_first_of("\"'[]{}=#\\\n\r") == text.npos)
    if (auto table = parsed_value("\"" + text + "\"", name)) return std::move(*table);
  throw BadSetting{"\"" + text + "\" is no value; write a number, true, a word, \"text\" or [list]"};
}

/// The element of [[list]] with this name.
toml::table& element(toml::table& root, const std::string& list, const std::string& name) {
  std::vector<std::string> names;
  if (auto* array = root[list].as_array())
    for (auto& item : *array) {
      auto* table = item.as_table();
      const auto its_name = table == nullptr ? std::nullopt : (*table)["name"].value<std::string>();
      if (its_name == name) return *table;
      if (its_name) names.push_back(*its_name);
    }
  throw BadSetting{fmt::format("no [[{}]] is called \"{}\"; {}", list, name,
                               advice(name, names, list == "body" ? "bodies" : "tools"))};
}

/// Puts the value of a holder { value = ... } into a table, key and value both placed at the setting.
toml::node& put(toml::table& table, const std::string& key, toml::table&& holder) {
  toml::key placed(key, toml::source_region(holder.find("value")->first.source()));
  table.erase(key);
  holder.get("value")->visit(
      [&](auto& value) { table.insert_or_assign(std::move(placed), std::move(value)); });
  return *table.get(key);
}

/// The table that a word of the path names, made if it is not there.
toml::table& step_into(toml::table& table, const std::string& word, const std::string& name) {
  auto* next = table.get(word);
  if (next == nullptr) next = &put(table, word, value_of("{}", name));
  if (auto* inner = next->as_table()) return *inner;
  throw BadSetting{fmt::format("\"{}\" is {}, not a table; it holds no keys", word, described(*next))};
}

/// Another driver has other keys: those that the file gives for its own go, those of other settings stay.
void forget_driver_keys(toml::table& device, const toml::table& holder) {
  const auto now = device["driver"].value<std::string>();
  if (!now || now == holder["value"].value<std::string>()) return;
  std::vector<std::string> own;
  for (const auto& [key, value] : device) {
    const bool shared = std::find(device_keys.begin(), device_keys.end(), key.str()) != device_keys.end();
    if (!shared && !place_of(value.source()).file.starts_with(setting_prefix)) own.emplace_back(key.str());
  }
  for (const auto& key : own) device.erase(key);
}

void apply(toml::table& root, const std::string& setting, const std::string& name) {
  const auto equals = setting.find('=');
  if (equals == setting.npos) throw BadSetting{"there is no \"=\"; write table.key=value"};
  const auto path = split_path(setting.substr(0, equals));
  auto holder = value_of(setting.substr(equals + 1), name);
  auto* table = &root;
  std::size_t i = 0;
  if (path[0] == "body" || path[0] == "tool") {
    if (path.size() < 3)
      throw BadSetting{fmt::format("which key of which {}? Write {}.NAME.key=value", path[0], path[0])};
    table = &element(root, path[0], path[1]);
    i = 2;
  }
  for (; i + 1 < path.size(); ++i) table = &step_into(*table, path[i], name);
  if (path.size() == 3 && path[0] == "device" && path[2] == "driver") forget_driver_keys(*table, holder);
  put(*table, path.back(), std::move(holder));
}

}  // namespace

void apply_settings(toml::table& root, const std::vector<std::string>& settings, Complaints& complaints) {
  for (const auto& setting : settings) {
    const auto name = std::string(setting_prefix) + setting;
    try {
      apply(root, setting, name);
    } catch (const BadSetting& bad) {
      complaints.add(Place{name, 0, 0}, Place{}, bad.what);
    }
  }
}

}  // namespace palpate
