#pragma once
// Where a benchmark leaves its results: DIR/NAME.csv, NAME.json (with the machine), NAME.png.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpate::bench {

/// A table with a heading that names units, written as CSV.
struct Table {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
  void add(std::vector<std::string> row) { rows.push_back(std::move(row)); }
};

/// Numbers as text: shortest that keeps six digits.
std::string text_of(double value);

class ResultFolder {
 public:
  /// Makes the folder. @throws InputError naming it
  ResultFolder(const std::string& folder, std::string name);

  std::filesystem::path file(const std::string& ending) const { return folder_ / (name_ + ending); }
  /// Writes NAME.csv whole or not at all. @throws InputError
  void write_csv(const Table& table) const;
  /// Writes NAME.json: {machine: ..., results: ...}. @throws InputError
  void write_json(const nlohmann::json& results) const;
  /// Draws with share/palpate/bench/plot_NAME.py; says in one line what hinders it. @return true if all went well
  bool plot() const;

 private:
  std::filesystem::path folder_;
  std::string name_;
};

}  // namespace palpate::bench
