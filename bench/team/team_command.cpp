// palpate bench team: what a second thread brings, on cores of its own and on cores that others use.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>

#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "bench/team/measure_team.h"
#include "common/error/error.h"
#include "common/process/checked_option.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_team";
  int rounds = 5;
  double seconds = 1;
  std::vector<int> busy;
};

int run_team(Options options) {
  const ResultFolder folder(options.out, "team");
  const int cores = static_cast<int>(std::max(2U, std::thread::hardware_concurrency()));
  if (options.busy.empty()) options.busy = {0, cores / 2, cores};
  const Handover handover = measure_handover(cores);
  fmt::print("a call of {} threads: {:.2f} us, {:.1f} us if they sleep, {:.2f} us on one\n", cores,
             handover.spinning_us, handover.sleeping_us, handover.alone_us);
  Table table{{"masses", "threads", "busy_processes", "one_us", "team_us", "chosen_us", "team_over_one",
               "chosen_over_one", "mean_threads"},
              {}};
  for (const int busy : options.busy)
    for (const double masses : {1.6e4, 1e5}) {
      const TeamCost c = measure_team(masses, cores, busy, options.seconds, options.rounds);
      fmt::print(
          "{:7} masses, {} busy: a step {:8.1f} us on one thread, {:.2f} times that on {}, {:.2f} as chosen "
          "({:.2f} "
          "threads)\n",
          c.masses, c.busy, c.one_us, c.team_ratio, c.threads, c.chosen_ratio, c.mean_threads);
      std::fflush(stdout);
      table.add({std::to_string(c.masses), std::to_string(c.threads), std::to_string(c.busy),
                 text_of(c.one_us), text_of(c.team_us), text_of(c.chosen_us), text_of(c.team_ratio),
                 text_of(c.chosen_ratio), text_of(c.mean_threads)});
    }
  folder.write_csv(table);
  folder.write_json({{"handover_us",
                      {{"spinning", handover.spinning_us},
                       {"sleeping", handover.sleeping_us},
                       {"alone", handover.alone_us}}}});
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_team(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("team", "what more threads bring, beside busy processes too");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--rounds", options->rounds, "one thread, team, choice in turns; the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 99));
  command->add_option("--seconds", options->seconds, "of each way and round")
      ->capture_default_str()
      ->check(number_in({.lo = 0.01, .hi = 60}));
  command->add_option("--busy", options->busy, "numbers of busy processes; else none, half the cores, all")
      ->check(CLI::Range(0, 256));
  command->callback([options, &exit_code] { exit_code = run_team(*options); });
}

}  // namespace palpate::bench
