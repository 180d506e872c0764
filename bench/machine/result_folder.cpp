#include "bench/machine/result_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <fstream>

#include "bench/machine/machine.h"
#include "common/error/error.h"
#include "common/report/json_file.h"
#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/plotter.h"

namespace palpate::bench {

std::string text_of(double value) { return fmt::format("{:.6g}", value); }

ResultFolder::ResultFolder(const std::string& folder, std::string name)
    : folder_(folder), name_(std::move(name)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw InputError(fmt::format("{}: {}; give another folder with --out", folder, error.message()));
}

void ResultFolder::write_csv(const Table& table) const {
  const auto path = file(".csv");
  const auto part = file(".csv.part");
  std::ofstream out(part);
  out << fmt::format("{}\n", fmt::join(table.heading, ","));
  for (const auto& row : table.rows) out << fmt::format("{}\n", fmt::join(row, ","));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, path, error);
  if (!out || error)
    throw InputError(
        fmt::format("{}: cannot be written; give a folder that may be written to", path.string()));
}

void ResultFolder::write_json(const nlohmann::json& results) const {
  palpate::write_json(file(".json").string(), {{"machine", machine()}, {"results", results}});
}

bool ResultFolder::plot() const {
  const auto program = deploy::share_folder() / "bench" / fmt::format("plot_{}.py", name_);
  const auto python = deploy::plot_interpreter();
  if (!std::filesystem::exists(program)) {
    std::fprintf(stderr, "palpate bench: %s is missing; install palpate again\n", program.c_str());
    return false;
  }
  if (!deploy::is_program(python)) {
    std::fprintf(stderr,
                 "palpate bench: no %s to draw plots with; install the packages python3 and "
                 "python3-matplotlib\n",
                 python.c_str());
    return false;
  }
  return deploy::Child(python, {program.string(), folder_.string()}).wait().clean();
}

}  // namespace palpate::bench
