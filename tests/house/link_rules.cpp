// Links between pages lead somewhere: to a file that is there, and to a heading that the page has.
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

/// What a heading is called in a link: "## The `guard`, again" is "the-guard-again".
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find(' ') + 1)) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0 || c == '-' || c == '_') anchor += static_cast<char>(std::tolower(letter));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchors_of(const SourceFile& page) {
  std::set<std::string> anchors;
  bool in_code = false;
  for (const auto& line : page.lines) {
    if (line.starts_with("```")) in_code = !in_code;
    if (!in_code && line.starts_with("#")) anchors.insert(anchor_of(line));
  }
  return anchors;
}

}  // namespace

std::vector<std::string> link_breaches(const std::vector<SourceFile>& files) {
  static const std::regex link("\\]\\(([^)#\\s]*)(?:#([^)\\s]*))?\\)");
  std::map<std::string, const SourceFile*> house;
  for (const auto& file : files) house[file.path] = &file;
  std::vector<std::string> breaches;
  for (const auto& page : files) {
    if (!page.path.ends_with(".md")) continue;
    for (std::size_t i = 0; i < page.lines.size(); ++i) {
      const auto& line = page.lines[i];
      for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; ++it) {
        const std::string path = (*it)[1], anchor = (*it)[2];
        if (path.find("://") != path.npos) continue;
        const auto folder = std::filesystem::path(page.path).parent_path();
        const auto target = path.empty() ? page.path : (folder / path).lexically_normal().generic_string();
        const auto found = house.lower_bound(target);
        const bool is_folder =
            found != house.end() && target.ends_with("/") && found->first.starts_with(target);
        const bool is_file = found != house.end() && found->first == target;
        const auto at = page.path + ":" + std::to_string(i + 1) + ": ";
        if (!is_file && !is_folder)
          breaches.push_back(at + "a link to " + target + ", which is not there; mend the path");
        else if (is_file && !anchor.empty() && !anchors_of(*found->second).contains(anchor))
          breaches.push_back(at + "a link to #" + anchor + ", which is no heading of " + target +
                             "; mend the anchor");
      }
    }
  }
  return breaches;
}

}  // namespace palpate::house
