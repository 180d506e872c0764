#include "common/scene/file_list.h"

#include <algorithm>

namespace palpate {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes the digits at the front of `text`, without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  auto number = text.substr(0, n);
  text.remove_prefix(n);
  while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  return number;
}

}  // namespace

bool fits_pattern(std::string_view name, std::string_view pattern) {
  // Greedy with one way back: after a mismatch the last * takes one character more.
  std::size_t n = 0, p = 0, star = pattern.npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == pattern.npos;
}

bool in_natural_order(std::string_view a, std::string_view b) {
  const auto whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const auto x = take_number(a), y = take_number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // slice_02 and slice_2
}

std::vector<std::string> files_of_pattern(const std::filesystem::path& pattern) {
  namespace fs = std::filesystem;
  const auto name = pattern.filename().string();
  const auto folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<std::string> names;
  if (name.find_first_of("*?") == name.npos) {
    if (fs::is_regular_file(pattern, error)) return {pattern.string()};
    return {};
  }
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const auto found = it->path().filename().string();
    if (it->is_regular_file(ignored) && fits_pattern(found, name)) names.push_back(found);
  }
  std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return in_natural_order(a, b); });
  for (auto& found : names) found = (pattern.parent_path() / found).string();
  return names;
}

}  // namespace palpate
