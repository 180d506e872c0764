// palpate bench outcomes: what becomes of a falling sphere over yield ratio, break ratio and speed.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <thread>

#include "bench/machine/result_folder.h"
#include "bench/outcomes/fragment_cost.h"
#include "bench/outcomes/sweep_falls.h"
#include "bench/problems/stopwatch.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/process/checked_option.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_outcomes";
  std::vector<double> speeds{0.5, 1, 2, 2.6};
  double seconds = 0.3;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

Table table_of(const std::vector<FallResult>& results) {
  Table table{{"y_p", "b_p_less_y_p", "speed_m_per_s", "outcome", "broken", "yielded", "fragments", "largest",
               "second", "shape", "energy_balance_error", "momentum_error", "restored"},
              {}};
  for (const FallResult& r : results) {
    const auto& m = r.measures;
    table.add({text_of(r.fall.y_p), text_of(r.fall.gap), text_of(r.fall.speed), physics::name_of(r.outcome),
               text_of(m.broken), text_of(m.yielded), std::to_string(m.fragments), text_of(m.largest),
               text_of(m.second), text_of(m.shape), text_of(r.balance_error), text_of(r.momentum_error),
               std::to_string(r.restored)});
  }
  return table;
}

int run_outcomes(const Options& options) {
  const ResultFolder folder(options.out, "outcomes");
  const std::vector<Fall> falls = fall_grid(options.speeds);
  const bool terminal = isatty(fileno(stdout)) != 0;
  const Stopwatch watch;
  const auto results = run_falls(falls, options.seconds, options.jobs, [&](std::size_t n) {
    if (terminal) fmt::print("\r{} of {} falls", n, falls.size()), std::fflush(stdout);
  });
  if (terminal) fmt::print("\n");
  nlohmann::json json = {{"falls", falls.size()},
                         {"seconds_each", options.seconds},
                         {"jobs", options.jobs},
                         {"wall_s", watch.wall_s()},
                         {"cpu_s", watch.cpu_s()},
                         {"thresholds",
                          {{"smash_largest", physics::smash_largest},
                           {"disunion_largest", physics::disunion_largest},
                           {"disunion_second", physics::disunion_second},
                           {"crack_cut", physics::crack_cut},
                           {"crush_yielded", physics::crush_yielded},
                           {"crush_shape", physics::crush_shape}}}};
  std::map<std::string, int> counts;
  std::vector<double> errors;
  double momentum = 0;
  for (const FallResult& r : results) {
    ++counts[physics::name_of(r.outcome)];
    errors.push_back(r.balance_error);
    momentum = std::max(momentum, r.momentum_error);
  }
  std::sort(errors.begin(), errors.end());
  for (const auto& [name, n] : counts) fmt::print("{:12} {:4} falls\n", name, n);
  json["outcomes"] = counts;
  json["energy_balance_error"] = {{"median", errors[errors.size() / 2]}, {"largest", errors.back()}};
  json["momentum_error_largest"] = momentum;
  fmt::print("{} falls in {:.0f} s; energy balance within {:.2g} (median {:.2g}), momentum within {:.1g}\n",
             results.size(), watch.wall_s(), errors.back(), errors[errors.size() / 2], momentum);
  for (const FragmentCost& cost : measure_fragment_cost(101)) {
    fmt::print(
        "{} masses, {:.0f} breaks a step: fragments followed in {:.1f} us, counted anew in {:.0f} us\n",
        cost.masses, cost.breaks, cost.follow_us, cost.flood_us);
    json["fragments"].push_back({{"masses", cost.masses},
                                 {"breaks_per_step", cost.breaks},
                                 {"follow_cpu_us", cost.follow_us},
                                 {"flood_cpu_us", cost.flood_us},
                                 {"fragments", cost.fragments}});
  }
  folder.write_csv(table_of(results));
  folder.write_json(json);
  const bool drawn = folder.plot();
  fmt::print("results: {}\n", options.out);
  return drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_outcomes(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("outcomes", "what becomes of a falling sphere: the phase diagram");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--speeds", options->speeds, "at which it meets the floor [m/s]; 100 falls each")
      ->capture_default_str()
      ->check(number_in({.lo = 0.01, .hi = 100}));
  command->add_option("--seconds", options->seconds, "of each fall")
      ->capture_default_str()
      ->check(number_in({.lo = 0.01, .hi = 10}));
  command->add_option("--jobs", options->jobs, "falls at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([options, &exit_code] { exit_code = run_outcomes(*options); });
}

}  // namespace palpate::bench
