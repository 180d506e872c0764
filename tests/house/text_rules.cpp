// What may not stand in a file: too much of it, promises, flags that change the bits, paths of somebody's machine.
// The forbidden words are put together here from two halves, so that this file may stand in the house itself.
#include <regex>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

constexpr std::size_t most_lines = 400;

struct Ban {
  std::regex files;    // where the rule holds
  std::regex pattern;  // what may not be there
  std::string advice;
};

const std::vector<Ban>& bans() {
  const std::string any = ".", code = "\\.(h|hpp|c|cc|cpp|idl|py|sh|cmake|txt|json|toml)$|^\\.ci/";
  static const std::vector<Ban> all = {
      {std::regex(any),
       std::regex("\\b(TO"
                  "DO|FIX"
                  "ME|XX"
                  "X)\\b"),
       "a promise in a file; do it, or leave it out"},
      {std::regex(code),
       std::regex("-f"
                  "fast-math|-O"
                  "fast|-f"
                  "unsafe-math|-f"
                  "finite-math"),
       "a flag that changes the bits and removes the guard against NaN; leave it out"},
      {std::regex(any),
       std::regex("(^|[^A-Za-z0-9_.])/(wo"
                  "rk/|tm"
                  "p/[A-Za-z0-9_-]*lab\\b|ho"
                  "me/[A-Za-z0-9_-]+|ro"
                  "ot/)"),
       "a path of one machine; write it from the root of the repository"},
  };
  return all;
}

bool is_counted(const std::string& path) {
  static const std::regex counted("\\.(h|hpp|c|cc|cpp|idl|py|sh|cmake|toml)$|CMakeLists\\.txt$");
  return std::regex_search(path, counted);
}

}  // namespace

std::vector<std::string> text_breaches(const SourceFile& file) {
  std::vector<std::string> breaches;
  const auto at = [&file](std::size_t line) { return file.path + ":" + std::to_string(line) + ": "; };
  if (is_counted(file.path) && file.lines.size() > most_lines)
    breaches.push_back(at(most_lines + 1) + "a file of " + std::to_string(file.lines.size()) +
                       " lines; one idea a file, at most " + std::to_string(most_lines));
  for (const auto& ban : bans()) {
    if (!std::regex_search(file.path, ban.files)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch match;
      if (std::regex_search(file.lines[i], match, ban.pattern))
        breaches.push_back(at(i + 1) + "\"" + match.str() + "\" is " + ban.advice);
    }
  }
  return breaches;
}

}  // namespace palpate::house
