// palpate bench haptic: is the hand's loop stable, true and harmless? All acceptance rows in simulated time.

#include <fmt/format.h>

#include <memory>
#include <thread>

#include "bench/haptic/press_pair.h"
#include "bench/haptic/rows.h"
#include "bench/haptic/solver_cost.h"
#include "bench/machine/result_folder.h"
#include "bench/problems/stopwatch.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_haptic";
  bool quick = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

Table table_of(const std::vector<CaseResult>& results) {
  Table table{{"mode", "device", "hand", "object", "rate_Hz", "delay_ms", "loss_percent", "stiffness_N_per_m",
               "damping_N_s_per_m", "swing_um", "force_N", "surplus_mJ", "plane_excess_mJ", "force_step_N"},
              {}};
  for (const CaseResult& r : results)
    table.add({name_of(r.c.mode), r.c.device.name, r.c.hand.name, r.c.object.name, text_of(r.c.rate_Hz),
               text_of(1e3 * r.c.link.delay), text_of(100 * r.c.link.loss), text_of(r.c.stiffness),
               text_of(r.c.damping), text_of(1e6 * r.swing), text_of(r.force), text_of(1e3 * r.surplus),
               text_of(1e3 * r.plane_excess), text_of(r.force_step)});
  return table;
}

/// Force over time, held and local. @return peak-to-peak after 3 s of both [N]
std::pair<double, double> write_pair(const std::string& out) {
  const auto held = press_with_60_grams(RenderMode::direct), local = press_with_60_grams(RenderMode::local);
  Table table{{"t_s", "held_force_N", "local_force_N", "held_z_mm", "local_z_mm"}, {}};
  for (std::size_t i = 0; i < held.size(); ++i)
    table.add({text_of(held[i].t), text_of(held[i].force), text_of(local[i].force), text_of(1e3 * held[i].z),
               text_of(1e3 * local[i].z)});
  ResultFolder(out, "haptic_press").write_csv(table);
  return {force_range(held, 3.0), force_range(local, 3.0)};
}

int run_haptic(const Options& options) {
  const ResultFolder folder(options.out, "haptic");
  Runs runs;
  runs.effort = options.quick ? Effort::quick : Effort::full;
  runs.jobs = options.jobs;
  const Stopwatch watch;
  bool all = true;
  nlohmann::json rows = nlohmann::json::array();
  for (const Row& row : all_rows(runs)) {
    fmt::print("{:4} {:4} {}\n          limit: {}\n          {}\n", row.id, row.pass ? "ok" : "NOT", row.what,
               row.limit, row.figure);
    all = all && row.pass;
    rows.push_back({{"id", row.id},
                    {"what", row.what},
                    {"limit", row.limit},
                    {"figure", row.figure},
                    {"pass", row.pass}});
  }
  const auto [held, local] = write_pair(options.out);
  fmt::print("60 g, 1 N, 600 N/m: force held at 50 Hz swings {:.2f} N, local plane {:.2g} N peak to peak\n",
             held, local);
  const SolverCost cost = measure_solver(20'000);
  fmt::print("proxy of 8 planes: {:.2f} us median, {:.2f} us p99 (CPU time)\n", cost.median_us, cost.p99_us);
  std::vector<CaseResult> cases = runs.seen;
  cases.insert(cases.end(), runs.raw.begin(), runs.raw.end());
  cases.insert(cases.end(), runs.world.begin(), runs.world.end());
  folder.write_csv(table_of(cases));
  folder.write_json({{"rows", rows},
                     {"cases", cases.size()},
                     {"quick", options.quick},
                     {"wall_s", watch.wall_s()},
                     {"cpu_s", watch.cpu_s()},
                     {"held_swing_N", held},
                     {"local_swing_N", local},
                     {"proxy_8_planes_cpu_us", {{"median", cost.median_us}, {"p99", cost.p99_us}}}});
  const bool drawn = folder.plot();
  fmt::print("results: {}\n", options.out);
  return all && drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_haptic(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("haptic", "stability, energy and truth of the hand's loop in simulated time");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_flag("--quick", options->quick, "some of the cases instead of all");
  command->add_option("--jobs", options->jobs, "cases at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([options, &exit_code] { exit_code = run_haptic(*options); });
}

}  // namespace palpate::bench
