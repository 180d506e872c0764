#pragma once
// What the text headers of MetaImage and NRRD have in common: lines of key and value, sizes, spacings, where the cells
// are. They are checked here before a library reads the file: it would take a missing spacing for 1 mm, and memory for
// whatever size the header claims.

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace palpate {

struct TextHeader {
  std::map<std::string, std::string> keys;  // in lower case
  std::uint64_t bytes = 0;                  // length of the header

  /// The value of the first of these keys that is there, or nullptr.
  const std::string* find(std::initializer_list<const char*> names) const;
};

/// Lines `key mark value` up to the line with the key `last` or an empty line.
TextHeader read_text_header(const std::string& path, char mark, const std::string& last);

std::string lower(std::string text);

/// All numbers of a text, whatever separates them. What is not a number ("none", say) is left out, but nan is one.
std::vector<double> numbers_of(std::string text);

/// How many cells. @throws InputError: not three axes, absurd; `text` is the value of the key `name`, or nullptr
std::uint64_t check_sizes(const std::string& path, const std::string* text, const char* name);

/// @throws InputError: not three, or not above 0 and at most 1 m
void check_spacings(const std::string& path, const std::vector<double>& mm);

/// The data file that a header names, beside it. @throws InputError: missing, or a list of files
std::string file_beside(const std::string& path, const std::string& name);

/// How the cells are stored.
struct CellStore {
  std::string file;
  std::uint64_t offset = 0;  // bytes before the cells
  std::uint64_t bytes = 0;   // of the cells, inflated
  bool deflated = false;
};

/// @throws InputError: the file cannot hold so many cells
void check_holds(const std::string& path, const CellStore& store);

}  // namespace palpate
