#include "common/process/checked_option.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace palpate {

CLI::Validator number_in(const Range& range) {
  const auto complaint = [range](const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, trouble] = std::from_chars(text.data(), end, value);
    if (trouble == std::errc::invalid_argument || stopped != end)
      return fmt::format("\"{}\" is no number; write {}", text, range.text());
    if (trouble == std::errc() && std::isfinite(value) && range.contains(value)) return std::string();
    return fmt::format("\"{}\" is out of range; write {}", text, range.text());
  };
  return {complaint, "", "number"};
}

}  // namespace palpate
