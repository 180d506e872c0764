// palpate bench skips: what it saves that a scene lacks something, and that cost follows what moves, not what exists.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/machine/result_folder.h"
#include "bench/skips/measure_skip.h"
#include "bench/skips/skip_cases.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_skips";
  int rounds = 5;
};

/// The round with the median time.
SceneCost middle(std::vector<SceneCost> costs) {
  const auto half = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), half, costs.end(),
                   [](const auto& a, const auto& b) { return a.us_per_frame < b.us_per_frame; });
  return *half;
}

std::vector<std::string> row(const SkipCase& c, const std::string& scene, const SceneCost& cost) {
  return {c.skip,
          scene,
          std::to_string(cost.masses),
          std::to_string(cost.moving),
          text_of(cost.us_per_frame),
          text_of(cost.load_s),
          text_of(cost.load_MB),
          text_of(cost.peak_MB),
          text_of(cost.asleep)};
}

int run_skips(const Options& options) {
  const ResultFolder folder(options.out, "skips");
  Table table{{"skip", "scene", "masses", "moving", "cpu_us_per_frame", "load_cpu_s", "world_MB", "peak_MB",
               "asleep"},
              {}};
  nlohmann::json json;
  for (const SkipCase& c : skip_cases(options.out)) {
    // In turns, so that what else the machine does falls on both alike.
    std::vector<SceneCost> lean, full;
    for (int round = 0; round < options.rounds; ++round) {
      lean.push_back(measure_scene(c.lean, c.frames, c.shaken));
      full.push_back(measure_scene(c.full, c.frames, c.shaken));
    }
    const SceneCost a = middle(lean), b = middle(full);
    fmt::print(
        "{:26} {:9.1f} us a frame  {:44} {:6.1f} MB\n{:26} {:9.1f} us a frame  {:44} {:6.1f} MB  {:.2f} "
        "times\n",
        c.skip, a.us_per_frame, c.without, a.load_MB, "", b.us_per_frame, c.with, b.load_MB,
        b.us_per_frame / a.us_per_frame);
    table.add(row(c, c.without, a));
    table.add(row(c, c.with, b));
    json[c.skip] = {{"time_ratio", b.us_per_frame / a.us_per_frame}, {"memory_ratio", b.load_MB / a.load_MB}};
  }
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_skips(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("skips", "what it saves that a scene lacks something");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--rounds", options->rounds, "of each scene, in turns; the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 99));
  command->callback([options, &exit_code] { exit_code = run_skips(*options); });
}

}  // namespace palpate::bench
