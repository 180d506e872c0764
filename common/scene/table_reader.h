#pragma once
// One table of a scene file, read strictly. It remembers which keys were asked for: the others are mistakes.
// Every read_ function returns nothing when the key is absent, and nothing plus one complaint when it is wrong,
// so that reading goes on and a person sees all mistakes at once.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/toml.h"

#include "common/math/vec3.h"
#include "common/scene/complaints.h"
#include "common/scene/place.h"
#include "common/scene/range.h"

namespace palpate {

/// What stands before "table.key=value" in the place of something given on the command line.
inline constexpr std::string_view setting_prefix = "--set ";

/// Where a node or key stands in its file; a --set has no line and column.
Place place_of(const toml::source_region& source);

/// A value as a person wrote it, shortened: 3, "word", a table.
std::string described(const toml::node& node);

class TableReader {
 public:
  /// @param title  how messages call the table: '[physics]', '[[body]] "head"'
  TableReader(const toml::table& table, std::string title, Complaints& complaints);
  /// The whole file: its own mistakes come before those of any table in it.
  static TableReader of_file(const toml::table& root, const std::string& path, Complaints& complaints);

  const Place& place() const { return place_; }
  const std::string& title() const { return title_; }
  bool has(std::string_view key) const { return table_.contains(key); }
  const toml::table& table() const { return table_; }  // as written, for who must look ahead

  /// The value of a key, which then counts as known.
  const toml::node* find(std::string_view key);
  /// The keys count as known, whatever they hold.
  void allow(const std::vector<std::string>& keys);
  /// Keys that nobody asked for so far.
  std::vector<std::string> left_over() const;
  /// Complains about them; call last.
  void refuse_left_over();

  std::optional<double> read_number(std::string_view key, const Range& range = any_number);
  std::optional<std::int64_t> read_integer(std::string_view key, std::int64_t lo, std::int64_t hi);
  std::optional<bool> read_flag(std::string_view key);
  std::optional<std::string> read_text(std::string_view key);
  /// Letters, digits, "_" and "-", at most 63: fits a topic and a file name.
  std::optional<std::string> read_name(std::string_view key);
  /// Index of the value among `words`.
  std::optional<std::size_t> read_word(std::string_view key, const std::vector<std::string>& words);
  /// For each of `words` whether it is in the list.
  std::optional<std::vector<bool>> read_words(std::string_view key, const std::vector<std::string>& words);
  /// An array of exactly n numbers. @param form  as a person should write it: "[x, y, z]"
  std::optional<std::vector<double>> read_numbers(std::string_view key, std::size_t n, std::string_view form,
                                                  const Range& range = any_number);
  std::optional<std::vector<int>> read_integers(std::string_view key, std::size_t n, std::string_view form,
                                                int lo, int hi);
  std::optional<Vec3> read_vector(std::string_view key, const Range& range = any_number);
  /// Of any length, however small or large.
  std::optional<Vec3> read_direction(std::string_view key);
  /// Millimetres in the file, metres here.
  std::optional<double> read_length_mm(std::string_view key, const Range& range = positive);
  std::optional<Vec3> read_vector_mm(std::string_view key, const Range& range = any_number);
  const toml::table* read_table(std::string_view key);
  const toml::array* read_array(std::string_view key, std::string_view form);

  /// '"key" in TITLE is VALUE; write EXPECTED', at the value.
  void complain_value(std::string_view key, const toml::node& value, std::string_view expected);
  /// The same of a word that is none of `words`, with the one that was probably meant. @param more  after the words
  void complain_word(std::string_view key, const toml::node& value, const std::vector<std::string>& words,
                     std::string_view more = "");
  /// Anything about a key, at its value if it is there, else at the table.
  void complain(std::string_view key, const std::string& what);
  /// Anything about some place in the table.
  void complain_at(const Place& where, const std::string& what);
  /// 'TITLE lacks WHAT; ADVICE', at the table.
  void complain_lack(std::string_view what, std::string_view advice);
  /// Complains unless the key is there.
  void require(std::string_view key, std::string_view advice);

 private:
  std::optional<double> number_of(std::string_view key, const toml::node& value, const Range& range);

  const toml::table& table_;
  std::string title_;
  Complaints& complaints_;
  Place place_;  // where the table begins
  Place group_;  // sorts its complaints
  std::vector<std::string> known_;
};

/// Numbers of an array that is no value of a key by itself, such as a row of a matrix; nothing if it is none.
std::optional<std::vector<double>> numbers_of(const toml::node& value, std::size_t n);

bool is_name(std::string_view text);

/// Overwrites a default if there is a value.
template <class Target, class Value>
void set_if(Target& target, const std::optional<Value>& value) {
  if (value) target = *value;
}

}  // namespace palpate
