#pragma once
// The tables of a reference page (docs/reference/*.md), so that a test can hold them to the program.

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace palpate::test {

/// Cells by the heading of their column, without backticks round code.
using Row = std::map<std::string, std::string>;

struct Section {
  std::string heading;  // of the nearest "#" line above, without backticks
  std::vector<Row> rows;
};

inline std::string without_backticks(std::string text) {
  std::erase(text, '`');
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line.substr(1, line.rfind('|') - 1));
  for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(without_backticks(cell));
  return cells;
}

/// A file of the sources. @throws std::runtime_error if there is none
inline std::string text_of_source(const std::string& path) {
  const char* root = std::getenv("PALPATE_SOURCE");
  std::ifstream file((root == nullptr ? std::string(".") : std::string(root)) + "/" + path);
  if (!file) throw std::runtime_error("no file " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// All sections of a page of the sources that have a table. @throws std::runtime_error if there is no such page
inline std::vector<Section> reference_page(const std::string& path) {
  std::istringstream file(text_of_source(path));
  std::vector<Section> sections;
  std::string heading;
  std::vector<std::string> columns;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) heading = without_backticks(line.substr(line.find_first_not_of('#')));
    if (!line.starts_with("|")) {
      columns.clear();
    } else if (columns.empty()) {
      columns = cells_of(line);
      if (sections.empty() || sections.back().heading != heading) sections.push_back({heading, {}});
    } else if (!line.starts_with("|-")) {
      Row row;
      const auto cells = cells_of(line);
      if (cells.size() != columns.size())
        throw std::runtime_error(path + ": a row with other cells: " + line);
      for (std::size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
      sections.back().rows.push_back(row);
    }
  }
  return sections;
}

/// All headings of a page, those without a table too.
inline std::vector<std::string> reference_headings(const std::string& path) {
  std::istringstream lines(text_of_source(path));
  std::vector<std::string> headings;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#"))
      headings.push_back(without_backticks(line.substr(line.find_first_not_of('#'))));
  return headings;
}

/// The rows under a heading. @throws std::runtime_error if there are none
inline const std::vector<Row>& rows_under(const std::vector<Section>& page, const std::string& heading) {
  for (const auto& section : page)
    if (section.heading == heading) return section.rows;
  throw std::runtime_error("the page has no table under \"" + heading + "\"");
}

}  // namespace palpate::test
