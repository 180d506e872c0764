// palpate bench touch: is the force of a pressed tip that of the tissue? Force over depth against closed forms and finer cells.

#include <fmt/format.h>

#include <memory>

#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "bench/touch/deep_rows.h"
#include "bench/touch/half_space_rows.h"
#include "bench/touch/reduced_rows.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_touch";
  bool finest = false;
};

int run_touch(const Options& options) {
  const ResultFolder folder(options.out, "touch");
  Table table{
      {"shape", "radius_m", "tissue", "cells_a_radius", "depth_m", "force_over_true", "radius_off_cells"},
      {}};
  nlohmann::json json;
  json["half_space"] = half_space_rows(table);
  json["coarse"] = coarse_rows();
  json["reduced"] = reduced_rows();
  json["deep"] = deep_rows(options.finest);
  folder.write_csv(table);
  folder.write_json(json);
  const bool drawn = folder.plot();
  fmt::print("results: {}\n", options.out);
  return drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_touch(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("touch", "force over depth of a pressed tip, against closed forms");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_flag("--finest", options->finest,
                    "also the sphere 5 mm deep on cells of 0.83 mm: an hour or more");
  command->callback([options, &exit_code] { exit_code = run_touch(*options); });
}

}  // namespace palpate::bench
