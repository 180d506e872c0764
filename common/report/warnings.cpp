#include "common/report/warnings.h"

#include <algorithm>
#include <utility>

namespace palpate {
namespace {

constexpr const char* key = "warnings";

}  // namespace

void add_warning(nlohmann::json& summary, std::string text) {
  nlohmann::json& lines = summary[key];
  if (!lines.is_array()) lines = nlohmann::json::array();
  if (std::find(lines.begin(), lines.end(), text) == lines.end()) lines.push_back(std::move(text));
}

void add_warnings(nlohmann::json& summary, std::span<const std::string> texts) {
  for (const std::string& text : texts) add_warning(summary, text);
}

void count_warnings(nlohmann::json& summary) { summary["guard"][key] = warnings_of(summary).size(); }

std::vector<std::string> warnings_of(const nlohmann::json& summary) {
  std::vector<std::string> texts;
  const auto lines = summary.find(key);
  if (lines == summary.end() || !lines->is_array()) return texts;
  for (const auto& line : *lines)
    if (line.is_string()) texts.push_back(line.get<std::string>());
  return texts;
}

}  // namespace palpate
