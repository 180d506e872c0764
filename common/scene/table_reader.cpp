#include "common/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/units.h"
#include "common/scene/near_miss.h"

namespace palpate {

namespace {

// Numbers beyond these are slips of the keyboard, whatever they stand for. Why: products and ratios of a few
// of them are finite, and whatever is measured in them is a number.
constexpr double smallest = 1e-12, largest = 1e12;
constexpr double longest_mm = 1e6;

bool is_usual(double number) {
  return number == 0 || (std::abs(number) >= smallest && std::abs(number) <= largest);
}

/// The lengths of a range that a scene can hold.
Range lengths(Range range) {
  range.lo = std::max(range.lo, -longest_mm);
  range.hi = std::min(range.hi, longest_mm);
  return range;
}

}  // namespace

Place place_of(const toml::source_region& source) {
  Place place;
  if (source.path) place.file = *source.path;
  if (place.file.starts_with(setting_prefix)) return place;
  place.line = static_cast<int>(source.begin.line);
  place.column = static_cast<int>(source.begin.column);
  return place;
}

std::string described(const toml::node& node) {
  constexpr std::size_t longest = 40;
  if (const auto* text = node.as_string()) {
    const auto& words = text->get();
    return words.size() <= longest ? fmt::format("\"{}\"", one_line(words)) : "a long text";
  }
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (const auto* array = node.as_array()) return fmt::format("a list of {}", array->size());
  return "a date or time";
}

bool is_name(std::string_view text) {
  constexpr std::size_t longest = 63;
  return !text.empty() && text.size() <= longest &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
             text.npos;
}

TableReader::TableReader(const toml::table& table, std::string title, Complaints& complaints)
    : table_(table),
      title_(std::move(title)),
      complaints_(complaints),
      place_(place_of(table.source())),
      group_(place_) {}

TableReader TableReader::of_file(const toml::table& root, const std::string& path, Complaints& complaints) {
  TableReader reader(root, "the scene", complaints);
  reader.place_ = {path, 1, 1};
  reader.group_ = Place{};
  return reader;
}

const toml::node* TableReader::find(std::string_view key) {
  allow({std::string(key)});
  return table_.get(key);
}

void TableReader::allow(const std::vector<std::string>& keys) {
  for (const auto& key : keys)
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

std::vector<std::string> TableReader::left_over() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : table_)
    if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) keys.emplace_back(key.str());
  return keys;
}

void TableReader::refuse_left_over() {
  for (const auto& unknown : left_over()) {
    const auto entry = table_.find(unknown);
    complaints_.add(
        place_of(entry->first.source()), group_,
        fmt::format("unknown key \"{}\" in {}; {}", unknown, title_, advice(unknown, known_, "known keys")),
        Complaints::Kind::unknown_key);
  }
}

void TableReader::complain_at(const Place& where, const std::string& what) {
  complaints_.add(where, group_, what);
}

void TableReader::complain(std::string_view key, const std::string& what) {
  const auto* value = table_.get(key);
  complain_at(value == nullptr ? place_ : place_of(value->source()), what);
}

void TableReader::complain_value(std::string_view key, const toml::node& value, std::string_view expected) {
  complain_at(place_of(value.source()),
              fmt::format("\"{}\" in {} is {}; write {}", key, title_, described(value), expected));
}

void TableReader::complain_word(std::string_view key, const toml::node& value,
                                const std::vector<std::string>& words, std::string_view more) {
  const auto meant = near_miss(value.value_or(std::string()), words);
  complain_value(key, value,
                 fmt::format("{}{}{}", quoted_list(words), more,
                             meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : ""));
}

void TableReader::complain_lack(std::string_view what, std::string_view advice) {
  complain_at(place_, fmt::format("{} lacks {}; {}", title_, what, advice));
}

void TableReader::require(std::string_view key, std::string_view advice) {
  if (!has(key)) complain_lack(fmt::format("\"{}\"", key), advice);
}

std::optional<double> TableReader::number_of(std::string_view key, const toml::node& value,
                                             const Range& range) {
  const auto number = value.is_number() ? value.value<double>() : std::nullopt;
  if (!number || !std::isfinite(*number) || !range.contains(*number)) {
    complain_value(key, value, range.text());
    return std::nullopt;
  }
  if (is_usual(*number)) return number;
  complain_value(key, value, fmt::format("{}, of {:g} to {:g} in size", range.text(), smallest, largest));
  return std::nullopt;
}

std::optional<double> TableReader::read_number(std::string_view key, const Range& range) {
  const auto* value = find(key);
  return value == nullptr ? std::nullopt : number_of(key, *value, range);
}

std::optional<std::int64_t> TableReader::read_integer(std::string_view key, std::int64_t lo,
                                                      std::int64_t hi) {
  const auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* number = value->as_integer())
    if (number->get() >= lo && number->get() <= hi) return number->get();
  complain_value(key, *value, fmt::format("a whole number from {} to {}", lo, hi));
  return std::nullopt;
}

std::optional<bool> TableReader::read_flag(std::string_view key) {
  const auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* flag = value->as_boolean()) return flag->get();
  complain_value(key, *value, "true or false");
  return std::nullopt;
}

std::optional<std::string> TableReader::read_text(std::string_view key) {
  const auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* text = value->as_string()) return text->get();
  complain_value(key, *value, "a text in quotes");
  return std::nullopt;
}

std::optional<std::string> TableReader::read_name(std::string_view key) {
  const auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* text = value->as_string(); text != nullptr && is_name(text->get())) return text->get();
  complain_value(key, *value, "a name of letters, digits, \"_\" and \"-\", at most 63 of them");
  return std::nullopt;
}

std::optional<std::size_t> TableReader::read_word(std::string_view key,
                                                  const std::vector<std::string>& words) {
  const auto* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* text = value->as_string()) {
    const auto found = std::find(words.begin(), words.end(), text->get());
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  complain_word(key, *value, words);
  return std::nullopt;
}

std::optional<std::vector<bool>> TableReader::read_words(std::string_view key,
                                                         const std::vector<std::string>& words) {
  const auto* list = read_array(key, "a list of " + quoted_list(words, "and"));
  if (list == nullptr) return std::nullopt;
  std::vector<bool> chosen(words.size(), false);
  for (const auto& item : *list) {
    const auto* text = item.as_string();
    const auto found = text == nullptr ? words.end() : std::find(words.begin(), words.end(), text->get());
    if (found == words.end())
      complain_word(key, item, words);
    else
      chosen[static_cast<std::size_t>(found - words.begin())] = true;
  }
  return chosen;
}

const toml::table* TableReader::read_table(std::string_view key) {
  const auto* value = find(key);
  if (value == nullptr || value->is_table()) return value == nullptr ? nullptr : value->as_table();
  complain_value(key, *value, "a table");
  return nullptr;
}

const toml::array* TableReader::read_array(std::string_view key, std::string_view form) {
  const auto* value = find(key);
  if (value == nullptr || value->is_array()) return value == nullptr ? nullptr : value->as_array();
  complain_value(key, *value, form);
  return nullptr;
}

std::optional<std::vector<double>> TableReader::read_numbers(std::string_view key, std::size_t n,
                                                             std::string_view form, const Range& range) {
  const auto* list = read_array(key, form);
  if (list == nullptr) return std::nullopt;
  if (list->size() != n) {
    complain_value(key, *list, form);
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (const auto& item : *list)
    if (const auto number = number_of(key, item, range)) numbers.push_back(*number);
  return numbers.size() == n ? std::optional(numbers) : std::nullopt;
}

std::optional<std::vector<int>> TableReader::read_integers(std::string_view key, std::size_t n,
                                                           std::string_view form, int lo, int hi) {
  const auto* list = read_array(key, form);
  if (list == nullptr) return std::nullopt;
  if (list->size() != n) {
    complain_value(key, *list, form);
    return std::nullopt;
  }
  std::vector<int> numbers;
  for (const auto& item : *list) {
    const auto* number = item.as_integer();
    if (number != nullptr && number->get() >= lo && number->get() <= hi)
      numbers.push_back(static_cast<int>(number->get()));
    else
      complain_value(key, item, fmt::format("a whole number from {} to {}", lo, hi));
  }
  return numbers.size() == n ? std::optional(numbers) : std::nullopt;
}

std::optional<Vec3> TableReader::read_vector(std::string_view key, const Range& range) {
  const auto numbers = read_numbers(key, 3, "[x, y, z]", range);
  if (!numbers) return std::nullopt;
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::optional<Vec3> TableReader::read_direction(std::string_view key) {
  const auto* value = find(key);
  const auto* list = value == nullptr ? nullptr : value->as_array();
  if (list == nullptr || list->size() != 3) return read_vector(key);
  Vec3 direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& item = *list->get(i);
    const auto number = item.is_number() ? item.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number)) return read_vector(key);  // says what is wrong
    direction[static_cast<Eigen::Index>(i)] = *number;
  }
  return direction;
}

std::optional<double> TableReader::read_length_mm(std::string_view key, const Range& range) {
  const auto length = read_number(key, lengths(range));
  return length ? std::optional(m_from_mm(*length)) : std::nullopt;
}

std::optional<Vec3> TableReader::read_vector_mm(std::string_view key, const Range& range) {
  const auto vector = read_vector(key, lengths(range));
  return vector ? std::optional<Vec3>(*vector * m_from_mm(1.0)) : std::nullopt;
}

std::optional<std::vector<double>> numbers_of(const toml::node& value, std::size_t n) {
  const auto* list = value.as_array();
  if (list == nullptr || list->size() != n) return std::nullopt;
  std::vector<double> numbers;
  for (const auto& item : *list) {
    const auto number = item.is_number() ? item.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number) || !is_usual(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace palpate
