// [[body]] and [material.NAME]: how a scene holds several of a kind, and how they refer to each other.
#include <fmt/format.h>

#include <algorithm>

#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"

namespace palpate {

std::vector<const toml::table*> tables_of_list(TableReader& root, const std::string& key, std::size_t most) {
  const auto form = fmt::format("each of them as a table under [[{}]]", key);
  std::vector<const toml::table*> tables;
  const auto* list = root.read_array(key, form);
  if (list == nullptr) return tables;
  for (const auto& item : *list) {
    if (!item.is_table())
      root.complain_value(key, item, form);
    else if (tables.size() == most)
      root.complain_at(place_of(item.source()), fmt::format("too many [[{}]]; at most {}", key, most));
    else
      tables.push_back(item.as_table());
    if (tables.size() == most && list->size() > most && &item != tables.back()) break;  // say it once
  }
  return tables;
}

std::vector<std::pair<std::string, const toml::table*>> named_tables(TableReader& root,
                                                                     const std::string& key) {
  std::vector<std::pair<std::string, const toml::table*>> tables;
  const auto* all = root.read_table(key);
  if (all == nullptr) return tables;
  for (const auto& [name, value] : *all) {
    const auto where = place_of(name.source());
    if (!is_name(name.str()))
      root.complain_at(
          where, fmt::format("\"{}\" is no name for a {}; use letters, digits, \"_\" and \"-\", at most 63",
                             name.str(), key));
    else if (!value.is_table())
      root.complain_at(where, fmt::format("\"{}.{}\" is {}; write a table [{}.{}]", key, name.str(),
                                          described(value), key, name.str()));
    else
      tables.emplace_back(name.str(), value.as_table());
  }
  const auto begin = [](const auto& entry) {
    const auto& source = entry.second->source().begin;
    return std::pair(source.line, source.column);
  };
  std::stable_sort(tables.begin(), tables.end(),
                   [&begin](const auto& a, const auto& b) { return begin(a) < begin(b); });
  return tables;
}

std::string list_title(const toml::table& table, const std::string& key) {
  const auto* name = table.get_as<std::string>("name");
  return name == nullptr || name->get().empty() ? fmt::format("[[{}]]", key)
                                                : fmt::format("[[{}]] \"{}\"", key, one_line(name->get()));
}

void refuse_known_name(TableReader& reader, const std::string& name, const std::vector<std::string>& taken) {
  if (name.empty() || std::find(taken.begin(), taken.end(), name) == taken.end()) return;
  reader.complain("name", fmt::format("the name \"{}\" is taken; give each its own", name));
}

void refuse_unknown_reference(TableReader& reader, const std::string& key, const std::string& wanted,
                              const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return;
  reader.complain(key, fmt::format("there is no [{}.{}]; {}", key, wanted,
                                   advice(wanted, names, fmt::format("{}s in this scene", key))));
}

}  // namespace palpate
