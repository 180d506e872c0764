#include "deploy/import/text_header.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

using Keys = std::map<std::string, std::string>;

constexpr std::size_t header_lines_limit = 4096;
constexpr std::size_t line_limit = 4096;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Lines `key mark value` up to the line with the key `last` or an empty line. Keys in lower case.
Keys keys_of(const std::string& path, char mark, const std::string& last) {
  std::ifstream file(path, std::ios::binary);
  Keys keys;
  std::string line(line_limit, '\0');
  for (std::size_t n = 0;
       n < header_lines_limit && file.getline(line.data(), static_cast<std::streamsize>(line_limit)); ++n) {
    const std::string text = trimmed(line.c_str());
    const auto at = text.find(mark);
    if (text.empty()) break;
    if (at == std::string::npos) continue;
    const std::string key = trimmed(lower(text.substr(0, at)));
    keys[key] = trimmed(text.substr(at + 1));
    if (key == last) break;
  }
  return keys;
}

const std::string* find(const Keys& keys, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto found = keys.find(name); found != keys.end()) return &found->second;
  return nullptr;
}

/// All numbers of a text, whatever separates them. What is not a number ("none", say) is left out, but nan is one.
std::vector<double> numbers_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ',' || c == '\t'; }, ' ');
  std::vector<double> numbers;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    double number = 0;
    const char* next = std::find(at, end, ' ');
    if (std::from_chars(at, next, number).ptr == next && next > at) numbers.push_back(number);
    at = next + 1;
  }
  return numbers;
}

void check_sizes(const std::string& path, const std::string* text, const char* name) {
  if (text == nullptr)
    throw InputError(path + ": its header lacks " + name + "; a three-dimensional image is wanted");
  const auto sizes = numbers_of(*text);
  std::array<std::int64_t, 3> size{};
  if (sizes.size() != 3)
    throw InputError(path + ": has " + std::to_string(sizes.size()) +
                     " axes; a three-dimensional image is wanted");
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[axis] = sizes[axis] >= 1 && sizes[axis] <= 1e9 ? static_cast<std::int64_t>(sizes[axis]) : 0;
  check_size(path, size);
}

void check_spacings(const std::string& path, const std::vector<double>& mm) {
  if (mm.size() != 3) throw InputError(path + ": its header gives no spacing of three axes; add it");
  check_spacing(path, {m_from_mm(mm[0]), m_from_mm(mm[1]), m_from_mm(mm[2])});
}

/// The data file beside the header. @throws InputError: missing, or a list of files
std::string beside(const std::string& path, const std::string& name) {
  if (lower(name).starts_with("list") || name.find('%') != std::string::npos)
    throw InputError(path + ": its cells are in a list of files; put them into one");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string file = (folder / name).string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(path + ": its cells should be in " + file + ", which is missing; put it there");
  return file;
}

}  // namespace

ImageFacts check_meta_header(const std::string& path) {
  const Keys keys = keys_of(path, '=', "elementdatafile");
  const std::string* data = find(keys, {"elementdatafile"});
  if (data == nullptr)
    throw InputError(path + ": is not a MetaImage, or is truncated; name a whole .mha or .mhd file");
  check_sizes(path, find(keys, {"dimsize"}), "DimSize");
  const std::string* spacing = find(keys, {"elementspacing", "elementsize"});
  check_spacings(path, spacing == nullptr ? std::vector<double>{} : numbers_of(*spacing));
  ImageFacts facts;
  facts.oriented = find(keys, {"transformmatrix", "rotation", "orientation"}) != nullptr;
  if (lower(*data) != "local") facts.data_file = beside(path, *data);
  return facts;
}

ImageFacts check_nrrd_header(const std::string& path) {
  const Keys keys = keys_of(path, ':', "");
  const std::string* sizes = find(keys, {"sizes"});
  if (sizes == nullptr)
    throw InputError(path + ": is not NRRD, or is truncated; name a whole .nrrd or .nhdr file");
  check_sizes(path, sizes, "sizes");
  std::vector<double> mm;
  if (const std::string* directions = find(keys, {"space directions"})) {
    const auto v = numbers_of(*directions);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3)
      mm.push_back(Eigen::Vector3d(v[i], v[i + 1], v[i + 2]).norm());
  } else if (const std::string* spacings = find(keys, {"spacings"})) {
    mm = numbers_of(*spacings);
  }
  check_spacings(path, mm);
  ImageFacts facts;
  const std::string* space = find(keys, {"space"});
  const std::string name = space == nullptr ? "" : lower(*space);
  facts.oriented = name == "lps" || name == "ras" || name == "las" || name.ends_with("-superior");
  if (const std::string* data = find(keys, {"data file", "datafile"})) facts.data_file = beside(path, *data);
  return facts;
}

}  // namespace palpate
