#include "deploy/import/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

constexpr std::size_t lines_limit = 4096;
constexpr std::size_t line_limit = 4096;
constexpr std::uint64_t deflate_at_most = 1100;  // cells' bytes in one deflated byte (RFC 1951)

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

const std::string* TextHeader::find(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (const auto found = keys.find(name); found != keys.end()) return &found->second;
  return nullptr;
}

TextHeader read_text_header(const std::string& path, char mark, const std::string& last) {
  std::ifstream file(path, std::ios::binary);
  TextHeader header;
  std::string line(line_limit, '\0');
  for (std::size_t n = 0; n < lines_limit; ++n) {
    if (!file.getline(line.data(), static_cast<std::streamsize>(line_limit))) break;
    header.bytes += static_cast<std::uint64_t>(file.gcount());
    const std::string text = trimmed(line.c_str());
    const auto at = text.find(mark);
    if (text.empty()) break;
    if (at == std::string::npos) continue;
    const std::string key = trimmed(lower(text.substr(0, at)));
    header.keys[key] = trimmed(text.substr(at + 1));
    if (key == last) break;
  }
  return header;
}

std::vector<double> numbers_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ',' || c == '\t'; }, ' ');
  std::vector<double> numbers;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    double number = 0;
    const char* next = std::find(at, end, ' ');
    if (next > at && std::from_chars(at, next, number).ptr == next) numbers.push_back(number);
    at = next + 1;
  }
  return numbers;
}

std::uint64_t check_sizes(const std::string& path, const std::string* text, const char* name) {
  if (text == nullptr)
    throw InputError(path + ": its header lacks " + name + "; a three-dimensional image is wanted");
  const auto sizes = numbers_of(*text);
  if (sizes.size() != 3)
    throw InputError(fmt::format("{}: has {} axes; a three-dimensional image is wanted", path, sizes.size()));
  std::array<std::int64_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[axis] = sizes[axis] >= 1 && sizes[axis] <= 1e9 ? static_cast<std::int64_t>(sizes[axis]) : 0;
  check_size(path, size);
  return static_cast<std::uint64_t>(size[0] * size[1] * size[2]);
}

void check_spacings(const std::string& path, const std::vector<double>& mm) {
  if (mm.size() != 3) throw InputError(path + ": its header gives no spacing of three axes; add it");
  check_spacing(path, {m_from_mm(mm[0]), m_from_mm(mm[1]), m_from_mm(mm[2])});
}

std::string file_beside(const std::string& path, const std::string& name) {
  if (lower(name).starts_with("list") || name.find('%') != std::string::npos)
    throw InputError(path + ": its cells are in a list of files; put them into one");
  const std::string file = (std::filesystem::path(path).parent_path() / name).string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(path + ": its cells should be in " + file + ", which is missing; put it there");
  return file;
}

void check_holds(const std::string& path, const CellStore& store) {
  const std::uint64_t length = std::filesystem::file_size(store.file);
  const std::uint64_t held = length - std::min(length, store.offset);
  const std::uint64_t least = store.deflated ? store.bytes / deflate_at_most : store.bytes;
  if (held < least)
    throw InputError(
        fmt::format("{}: damaged or truncated, {} bytes are there for cells of {}; fetch a whole copy", path,
                    held, store.bytes));
}

}  // namespace palpate
