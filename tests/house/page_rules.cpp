// Reference pages against the sources that they speak of, as text: fields of the wire, stages of a frame, options of the
// drivers, words of summary.json, and the files that docs/contributing.md names.
#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "common/scene/scene.h"
#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

using Words = std::vector<std::string>;
using Set = std::set<std::string>;

/// The whole tree by path.
struct House {
  std::map<std::string, const SourceFile*> files;
  const SourceFile* find(const std::string& path) const {
    const auto at = files.find(path);
    return at == files.end() ? nullptr : at->second;
  }
};

/// First and second cell of the rows of a page, each behind the heading that they stand under, without backticks.
struct Cells {
  std::string heading, first, second;
  std::size_t line = 0;
};
std::vector<Cells> cells_of(const SourceFile& page) {
  static const std::regex row("^\\| ([^|]*) \\| ?([^|]*)\\|.*$"), heading("^#+ (.*)$");
  std::vector<Cells> all;
  std::string under;
  bool in_table = false;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    std::string text = page.lines[i];
    std::erase(text, '`');
    std::smatch match;
    if (std::regex_match(text, match, heading)) under = match[1];
    if (!text.starts_with("|")) {
      in_table = false;
    } else if (!in_table) {
      in_table = true;  // the headings of the columns
    } else if (std::regex_match(text, match, row)) {
      std::string second = match[2];
      while (second.ends_with(" ")) second.pop_back();
      all.push_back({under, match[1], second, i + 1});
    }
  }
  return all;
}

/// All first groups of a pattern in a file.
Words matches_of(const SourceFile& file, const std::regex& pattern) {
  Words words;
  for (const auto& line : file.lines)
    for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it)
      words.push_back((*it)[1]);
  return words;
}

/// One breach for each word that is in one of the two and not in the other.
void compare(Words& breaches, const std::string& page, const Set& listed, const std::string& source,
             const Set& there) {
  for (const auto& word : there)
    if (!listed.contains(word))
      breaches.push_back(page + ":1: lacks \"" + word + "\" of " + source + "; add its row");
  for (const auto& word : listed)
    if (!there.contains(word))
      breaches.push_back(page + ":1: \"" + word + "\" is not in " + source + "; take its row out");
}

void check_topics(const House& house, Words& breaches) {
  const std::string page = "docs/reference/topics.md", source = "idl/palpate.idl";
  if (house.find(page) == nullptr || house.find(source) == nullptr) return;
  static const std::regex structure("struct (\\w+) \\{"), field("^  (@key )?(\\w+) (\\w+)((?:\\[\\w+\\])*);");
  Set there, listed;
  std::string name;
  for (const auto& line : house.find(source)->lines) {
    std::smatch match;
    if (std::regex_search(line, match, structure)) name = match[1];
    if (!std::regex_search(line, match, field)) continue;
    there.insert(name + "." + match[3].str() + " " + match[2].str() + match[4].str() +
                 (match[1].matched ? ", key" : ""));
  }
  for (const auto& row : cells_of(*house.find(page)))
    listed.insert(row.heading + "." + row.first + " " + row.second);
  compare(breaches, page, listed, source, there);
}

/// fields() of a message names the fields of the IDL in its order, so that none is left out of conversion and checks.
void check_messages(const House& house, Words& breaches) {
  const std::string source = "idl/palpate.idl";
  if (house.find(source) == nullptr) return;
  static const std::regex structure("struct (\\w+) \\{"), field("^  (?:@key )?\\w+ (\\w+)(?:\\[\\w+\\])*;"),
      named("visit(?:\\.\\w+)?\\(PALPATE_FIELD\\((\\w+)\\)"), header("^common/message/\\w+_messages\\.h$");
  std::map<std::string, Words> declared, described;
  const auto collect = [](const SourceFile& file, const std::regex& pattern,
                          std::map<std::string, Words>& by) {
    std::string name;
    std::smatch match;
    for (const auto& line : file.lines) {
      if (std::regex_search(line, match, structure)) name = match[1];
      if (std::regex_search(line, match, pattern) && match[1] != "version") by[name].push_back(match[1]);
    }
  };
  collect(*house.find(source), field, declared);
  std::map<std::string, std::string> place;
  for (const auto& [path, file] : house.files) {
    if (!std::regex_match(path, header)) continue;
    std::map<std::string, Words> here;
    collect(*file, named, here);
    for (auto& [name, words] : here) place[name] = path, described[name] = std::move(words);
  }
  if (described.empty()) return;
  for (const auto& [name, fields] : declared)
    if (described[name] != fields)
      breaches.push_back((place.contains(name) ? place[name] : source) + ":1: fields() of " + name +
                         " does not name the fields of " + source + " in its order");
}

void check_stages(const House& house, Words& breaches) {
  const std::string page = "docs/reference/stages.md", source = "physics_node/step/step_report.h";
  if (house.find(page) == nullptr || house.find(source) == nullptr) return;
  Words there, listed;
  bool inside = false;
  static const std::regex stage("^  (\\w+),");
  for (const auto& line : house.find(source)->lines) {
    std::smatch match;
    if (line.find("enum class Stage") != line.npos) inside = true;
    if (line.starts_with("};")) inside = false;
    if (inside && std::regex_search(line, match, stage)) there.push_back(match[1]);
  }
  for (const auto& row : cells_of(*house.find(page)))
    if (row.heading == "Stages") listed.push_back(row.first);
  compare(breaches, page, Set(listed.begin(), listed.end()), source, Set(there.begin(), there.end()));
  if (breaches.empty() && listed != there)
    breaches.push_back(page + ":1: stages in another order than in " + source + "; put them in its order");
}

void check_driver_options(const House& house, Words& breaches) {
  const std::string page = "docs/reference/scene.md";
  if (house.find(page) == nullptr) return;
  static const std::regex driver("^haptic_node/drivers/(\\w+)/\\1_driver\\.cpp$");
  static const std::regex asked("options\\.(?:text|positive|number|whole|yes|numbers)\\(\"(\\w+)\"");
  // What the host tells the driver of the mouse, not a person.
  const Set of_the_host = {"mouse world_scale", "mouse world_rotation", "mouse world_offset_m", "mouse tool",
                           "mouse domain"};
  Set there, listed;
  for (const auto& [path, file] : house.files) {
    std::smatch match;
    if (!std::regex_match(path, match, driver)) continue;
    for (const auto& option : matches_of(*file, asked))
      if (!of_the_host.contains(match[1].str() + " " + option)) there.insert(match[1].str() + " " + option);
  }
  for (const auto& row : cells_of(*house.find(page)))
    if (row.heading == "Options of the drivers" && row.first != "all")
      listed.insert(row.first + " " + row.second);
  compare(breaches, page, listed, "haptic_node/drivers", there);
}

/// Keys of a JSON object in a source: {"key", value} and report["key"].
void check_summary_words(const House& house, Words& breaches) {
  const std::string page = "docs/reference/summary.md";
  if (house.find(page) == nullptr) return;
  static const std::regex key("(?:\\{|[\\w\\]]\\[)\"([a-z]\\w*)\"(?=[,\\]])");
  const std::map<std::string, Words> sources = {
      {"Hand", {"haptic_node/loop/haptic_summary.cpp"}},
      {"Pictures", {"render_node/render_loop.cpp", "deploy/palpate/virtual_eye.cpp"}},
      {"Surfaces", {"physics_node/appearance/surface_bytes_report.h"}},
      {"Wire", {"common/wire/wire_report.h", "common/wire/heard_report.cpp"}},
      {"Nodes", {"deploy/palpate/summary.cpp"}}};
  // Written by the source, but listed under Physics; exit_code and signal are two words of one line.
  const Set elsewhere = {"warnings", "scene", "commit", "seed", "wall_s"};
  const Set placeholders = {"NODE", "TOPIC", "NAME"};
  for (const auto& [heading, paths] : sources) {
    Set there, listed;
    for (const auto& path : paths) {
      if (house.find(path) == nullptr) continue;
      for (const auto& word : matches_of(*house.find(path), key))
        if (!elsewhere.contains(word)) there.insert(word);
      for (const auto& word : matches_of(*house.find(path), std::regex("[?:] \"([a-z_]+)\"(?= :|\\])")))
        there.insert(word);
    }
    if (there.empty()) continue;
    for (const auto& row : cells_of(*house.find(page))) {
      if (row.heading != heading) continue;
      std::string word;
      for (const char c : row.first + ".") {
        if (c != '.')
          word += c;
        else if (!placeholders.contains(word))
          listed.insert(word), word.clear();
        else
          word.clear();
      }
    }
    compare(breaches, page, listed, paths.front(), there);
  }
}

/// Every path in the lists of docs/contributing.md is there. NAME stands for what a person is going to add: what is before it is
/// looked for.
void check_named_files(const House& house, Words& breaches) {
  const std::string page = "docs/contributing.md";
  const auto* file = house.find(page);
  if (file == nullptr) return;
  static const std::regex path("`([\\w.-]+/[\\w./*-]*|CMakeLists\\.txt|README\\.md)`");
  std::size_t n = 0;
  for (std::size_t i = 0; i < file->lines.size(); ++i) {
    const auto& line = file->lines[i];
    for (std::sregex_iterator it(line.begin(), line.end(), path), end; it != end; ++it) {
      std::string name = (*it)[1];
      const auto ends = std::min(name.find("NAME"), name.find('*'));
      const bool open = ends != name.npos || name.ends_with("/");
      name = name.substr(0, ends);
      const auto found = house.files.lower_bound(name);
      const bool is_there =
          found != house.files.end() && (open ? found->first.starts_with(name) : found->first == name);
      ++n;
      if (!is_there)
        breaches.push_back(page + ":" + std::to_string(i + 1) + ": there is no " + (*it)[1].str() +
                           "; name the file that is touched today");
    }
  }
  if (n == 0) breaches.push_back(page + ":1: names no file; list those that a change touches");
}

/// What any page calls a file or folder of the house is the beginning of one, since many are named without their ending.
void check_mentioned_files(const House& house, Words& breaches) {
  static const std::regex path(
      "`((?:idl|common|physics_node|haptic_node|render_node|deploy|bench|tests|scenes|cmake)/[\\w./"
      "*{}-]*)[^`]*`");
  for (const auto& [page, file] : house.files) {
    if (!page.ends_with(".md") || page == "docs/contributing.md") continue;
    for (std::size_t i = 0; i < file->lines.size(); ++i)
      for (const auto& name : matches_of({page, {file->lines[i]}}, path)) {
        const auto begin = name.substr(0, name.find_first_of("*{"));
        const auto known = begin.substr(0, begin.find("NAME"));
        const auto found = house.files.lower_bound(known);
        if (found == house.files.end() || !found->first.starts_with(known))
          breaches.push_back(page + ":" + std::to_string(i + 1) + ": there is no " + name +
                             "; name the file as it is called today");
      }
  }
}

}  // namespace

std::vector<std::string> page_breaches(const std::vector<SourceFile>& files) {
  House house;
  for (const auto& file : files) house.files[file.path] = &file;
  Words breaches;
  check_stages(house, breaches);
  check_topics(house, breaches);
  check_messages(house, breaches);
  check_driver_options(house, breaches);
  check_summary_words(house, breaches);
  check_named_files(house, breaches);
  check_mentioned_files(house, breaches);
  return breaches;
}

}  // namespace palpate::house
