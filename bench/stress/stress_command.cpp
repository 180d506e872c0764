// palpate bench stress: thousands of scenes that nobody should load, and what must never happen in any.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "bench/machine/result_folder.h"
#include "bench/stress/batch.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_stress";
  std::uint64_t seeds = 1000, first = 1;
  std::optional<std::uint64_t> one;
  std::string model = "springs";
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

ElementModel model_of(const Options& options) {
  return options.model == "fem" ? ElementModel::fem : ElementModel::springs;
}

int replay(std::uint64_t seed, ElementModel model) {
  const StressResult result =
      run_stress(seed, model, [](const std::string& line) { fmt::print("{}\n", line); });
  fmt::print("seed {}: {}; finite {}, growth {:.4g} (bound {}), guard acted {} times, diagnosis {}\n", seed,
             result.passes() ? "passes" : "FAILS", result.finite, result.growth, growth_bound,
             result.restored, result.diagnosis);
  return result.passes() ? exit_ok : exit_failed;
}

/// How many of each integrator ended how, for a person and for the file.
nlohmann::json counts(const BatchResults& all) {
  struct Count {
    std::int64_t scenes = 0, nonfinite = 0, grown = 0, restored = 0, stopped = 0;
  };
  std::map<std::string, Count> by;
  for (const auto& r : all.results) {
    Count& c = by[r.integrator];
    ++c.scenes;
    c.nonfinite += !r.finite;
    c.grown += !(r.growth <= growth_bound);
    c.restored += r.restored > 0;
    c.stopped += r.diagnosis != "none";
  }
  nlohmann::json json;
  for (const auto& [name, c] : by) {
    fmt::print(
        "{:16} {:6} scenes: {} not finite, {} above the energy bound, {} restored by the guard, {} stopped\n",
        name, c.scenes, c.nonfinite, c.grown, c.restored, c.stopped);
    json[name] = {{"scenes", c.scenes},
                  {"nonfinite", c.nonfinite},
                  {"above_bound", c.grown},
                  {"restored", c.restored},
                  {"stopped", c.stopped}};
  }
  return json;
}

void show_worst(std::vector<StressResult> results) {
  // What is not a number is worst of all.
  const auto badness = [](const StressResult& r) {
    return r.finite && r.growth == r.growth ? r.growth : 1e300;
  };
  std::sort(results.begin(), results.end(),
            [&](const auto& a, const auto& b) { return badness(a) > badness(b); });
  results.resize(std::min<std::size_t>(results.size(), 8));
  for (const auto& r : results)
    fmt::print("  seed {:6}  growth {:10.4g}  finite {}  {} {} {} start {} step {:.2f}\n", r.seed, r.growth,
               r.finite, r.integrator, r.lattice, r.precision, r.start, r.step_ratio);
}

int run_stress_command(const Options& options) {
  if (options.one) return replay(*options.one, model_of(options));
  const ResultFolder folder(options.out, "stress");
  const bool terminal = isatty(fileno(stdout)) != 0;
  const BatchResults all = run_batches(
      options.first, options.seeds, model_of(options), options.jobs, options.out, [&](std::uint64_t n) {
        if (terminal) fmt::print("\r{} of {} scenes", n, options.seeds), std::fflush(stdout);
      });
  if (terminal) fmt::print("\n");
  Table table{stress_heading(), {}};
  for (const auto& result : all.results) table.add(words(result));
  folder.write_csv(table);
  nlohmann::json json = {{"first", options.first},
                         {"seeds", options.seeds},
                         {"model", options.model},
                         {"growth_bound", growth_bound}};
  json["integrators"] = counts(all);
  for (const auto& crash : all.crashes) {
    fmt::print("seed {}: {}\n", crash.seed, crash.how);
    json["crashes"].push_back({{"seed", crash.seed}, {"how", crash.how}});
  }
  fmt::print("largest growth of energy (replay with --seed):\n");
  show_worst(all.results);
  folder.write_json(json);
  const bool drawn = all.results.empty() || folder.plot();
  const bool clean = all.crashes.empty() && std::all_of(all.results.begin(), all.results.end(),
                                                        [](const auto& r) { return r.passes(); });
  fmt::print("{} scenes, {} crashes: {}; results: {}\n", all.results.size(), all.crashes.size(),
             clean ? "all pass" : "FAILED", options.out);
  return clean && drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_stress(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("stress", "random abuse: nothing that is not finite, no energy from nothing");
  auto options = std::make_shared<Options>();
  command->add_option("--seeds", options->seeds, "how many scenes")->capture_default_str();
  command->add_option("--first", options->first, "the first seed")->capture_default_str();
  command->add_option("--seed", options->one, "one scene, with every frame in words");
  command->add_option("--model", options->model, "what the bodies are made of: springs or fem")
      ->capture_default_str()
      ->check(CLI::IsMember({"springs", "fem"}));
  command->add_option("--jobs", options->jobs, "processes at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_stress_command(*options); });
}

}  // namespace palpate::bench
