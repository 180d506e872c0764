#pragma once
// The words of a text and where they stand, for readers that must say so.

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "common/error/error.h"
#include "common/scene/complaints.h"

namespace palpate::physics {

/// Goes through a text word by word. Words are what stands between white space.
class MeshWords {
 public:
  MeshWords(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// The next word, on this line or a later one; empty at the end.
  std::string_view next() {
    skip(true);
    return take();
  }
  /// The next word on this line; empty where the line ends.
  std::string_view next_on_line() {
    skip(false);
    return take();
  }
  /// The next word, on this line or a later one, which stays the next.
  std::string_view peek() {
    const MeshWords before = *this;
    const std::string_view word = next();
    at_ = before.at_, line_begin_ = before.line_begin_, current_line_ = before.current_line_;
    line_ = before.line_, column_ = before.column_;
    return word;
  }
  /// To the next line that has a word.
  void next_line() { skip(true); }
  /// What is left of this line is not read.
  void end_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  /// The whole next line is not read, empty or not.
  void skip_next_line() {
    end_line();
    if (at_ < text_.size()) ++at_, ++current_line_, line_begin_ = at_;
    end_line();
  }
  /// Of Gmsh's formats: to behind the end of the section whose name, with "$", was the last word.
  void skip_section(std::string_view section) {
    const std::string end = "$End" + std::string(section.substr(1));
    const std::size_t line = line_;
    end_line();
    for (auto word = next(); word != end; word = next()) {
      if (word.empty())
        complain_of(line, 1, quoted(section) + " has no end; " + end.substr(0, 40) + " is missing");
      end_line();
    }
  }
  std::size_t bytes_left() const noexcept { return text_.size() - at_; }
  std::size_t line() const noexcept { return line_; }  // of the last word

  /// A whole number on this line. @param what  it is, for messages
  long long integer(const std::string& what, long long least, long long most) {
    const std::string_view word = next_on_line();
    const std::string_view digits = without_plus(word);
    long long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < least || value > most)
      complain(quoted(word) + " is no " + what + "; a whole number from " + std::to_string(least) + " to " +
               std::to_string(most) + " stands here");
    return value;
  }
  /// A finite number on this line of at most `most`, whatever its sign.
  double number(const std::string& what, double most) {
    const std::string_view word = next_on_line();
    const std::string_view digits = without_plus(word);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value) ||
        std::abs(value) > most)
      complain(quoted(word) + " is no " + what + "; a finite number, at most " + std::to_string(most) +
               " in size, stands here");
    return value;
  }
  void expect(std::string_view word) {
    const std::string_view found = next();
    if (found != word) complain(quoted(found) + " where " + std::string(word) + " should stand");
  }

  /// @throws InputError: about the last word
  [[noreturn]] void complain(const std::string& what) const { complain_of(line_, column_, what); }
  [[noreturn]] void complain_of(std::size_t line, std::size_t column, const std::string& what) const {
    throw InputError(
        one_line(name_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what));
  }
  static std::string quoted(std::string_view word) {
    return word.empty() ? "the end" : "\"" + std::string(word.substr(0, 40)) + "\"";
  }

 private:
  static std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
  }
  void skip(bool over_lines) {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!over_lines) return;
        ++current_line_, line_begin_ = at_ + 1;
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }
  std::string_view take() {
    line_ = current_line_, column_ = at_ - line_begin_ + 1;
    const std::size_t from = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r' &&
           text_[at_] != '\n')
      ++at_;
    return text_.substr(from, at_ - from);
  }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0, line_begin_ = 0, current_line_ = 1;
  std::size_t line_ = 1, column_ = 1;  // of the last word
};

}  // namespace palpate::physics
