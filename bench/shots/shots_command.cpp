// palpate bench shots: does anything go through anything?

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "bench/machine/result_folder.h"
#include "bench/problems/side_by_side.h"
#include "bench/problems/stopwatch.h"
#include "bench/shots/shot.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/process/checked_option.h"
#include "common/scene/surroundings_spec.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_shots";
  std::uint64_t shots = 1000, first = 1;
  std::optional<std::uint64_t> one;
  double fastest = 100;  // [m/s]
  bool paper = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

std::string text_of_shot(const ShotResult& r) {
  return fmt::format(
      "seed {}: {} at {:.3g} m/s: {} collisions, {} made to move together, {} passages, {} pairs without "
      "room, "
      "{} restored, {} inside, {} spilled",
      r.seed, r.target, r.speed, r.collisions, r.stopped, r.passages, r.overflows, r.restored, r.inside,
      r.spilled);
}

Table table_of(const std::vector<ShotResult>& results) {
  Table table{{"seed", "target", "speed_m_per_s", "collisions", "stopped", "passages", "overflows",
               "restored", "inside", "spilled"},
              {}};
  for (const ShotResult& r : results)
    table.add({std::to_string(r.seed), r.target, text_of(r.speed), std::to_string(r.collisions),
               std::to_string(r.stopped), std::to_string(r.passages), std::to_string(r.overflows),
               std::to_string(r.restored), std::to_string(r.inside), std::to_string(r.spilled)});
  return table;
}

int run_shots(const Options& options) {
  const ContactDistance distance = options.paper ? ContactDistance::paper : ContactDistance::swept;
  const auto shoot = [&](std::uint64_t seed) {
    return run_shot(random_shot(seed, options.fastest, distance));
  };
  if (options.one) {
    const ShotResult result = shoot(*options.one);
    fmt::print("{}\n", text_of_shot(result));
    return options.paper || result.passes() ? exit_ok : exit_failed;
  }
  const ResultFolder folder(options.out, "shots");
  const bool terminal = isatty(fileno(stdout)) != 0;
  const Stopwatch watch;
  std::vector<ShotResult> results(options.shots);
  side_by_side(
      results.size(), options.jobs, [&](std::size_t n) { results[n] = shoot(options.first + n); },
      [&](std::size_t n) {
        if (terminal) fmt::print("\r{} of {} shots", n, results.size()), std::fflush(stdout);
      });
  if (terminal) fmt::print("\n");
  std::int64_t failed = 0, passages = 0, inside = 0, spilled = 0, with_passages = 0;
  for (const ShotResult& r : results) {
    failed += !r.passes();
    passages += r.passages;
    with_passages += r.passages > 0;
    inside += r.inside;
    spilled += r.spilled > 0;
    if (!options.paper && !r.passes()) fmt::print("{}\n", text_of_shot(r));
  }
  folder.write_csv(table_of(results));
  folder.write_json({{"shots", options.shots},
                     {"first", options.first},
                     {"fastest_m_per_s", options.fastest},
                     {"distance", options.paper ? "paper" : "swept"},
                     {"passages", passages},
                     {"shots_with_passages", with_passages},
                     {"inside", inside},
                     {"shots_with_spilled", spilled},
                     {"failed", failed},
                     {"wall_s", watch.wall_s()},
                     {"cpu_s", watch.cpu_s()}});
  fmt::print(
      "{} shots of 0.1 to {} m/s in {:.0f} s: {} masses passed a facet (in {} shots), {} ended inside; inner "
      "masses left "
      "their own skin in {} shots; results: {}\n",
      results.size(), options.fastest, watch.wall_s(), passages, with_passages, inside, spilled, options.out);
  return options.paper || failed == 0 ? exit_ok : exit_failed;
}

}  // namespace

void add_shots(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("shots", "spheres shot at plates, tubes and spheres: does any mass go through?");
  auto options = std::make_shared<Options>();
  command->add_option("--shots", options->shots, "how many")->capture_default_str();
  command->add_option("--first", options->first, "the first seed")->capture_default_str();
  command->add_option("--seed", options->one, "one shot");
  command->add_option("--fastest", options->fastest, "[m/s]")
      ->capture_default_str()
      ->check(number_in({.lo = 0.2, .hi = 1000}));
  command->add_flag("--paper", options->paper,
                    "contact of the paper, which lets masses through: counts them");
  command->add_option("--jobs", options->jobs, "shots at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_shots(*options); });
}

}  // namespace palpate::bench
