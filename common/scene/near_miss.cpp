#include "common/scene/near_miss.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace palpate {
namespace {

/// Least number of letters to put in, take out, change or swap with the next (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    d[i][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, changed});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> near_miss(std::string_view given, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 64;
  if (given.empty() || given.size() > longest) return std::nullopt;
  std::optional<std::string> best;
  std::size_t least = std::min<std::size_t>(3, given.size() / 3 + 1);  // from here on it is another word
  for (const auto& word : known) {
    const auto distance = edit_distance(given, word);
    if (distance < least) {
      least = distance;
      best = word;
    }
  }
  if (best) return best;
  for (const auto& word : known)
    if (given.size() >= 3 && word.starts_with(std::string(given) + "_")) return word;
  return std::nullopt;
}

std::string quoted_list(const std::vector<std::string>& words, std::string_view last_joint) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 == words.size() ? fmt::format(" {} ", last_joint) : ", ";
    list += fmt::format("\"{}\"", words[i]);
  }
  return list;
}

std::string advice(std::string_view given, const std::vector<std::string>& known, std::string_view noun) {
  if (const auto meant = near_miss(given, known)) return fmt::format("did you mean \"{}\"?", *meant);
  if (known.empty()) return fmt::format("there are no {}", noun);
  return fmt::format("{}: {}", noun, quoted_list(known, "and"));
}

}  // namespace palpate
