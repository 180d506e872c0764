// palpate bench haptic: is the hand's loop stable, true and harmless? All acceptance rows in simulated time.

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <memory>
#include <numbers>
#include <thread>

#include "bench/haptic/press_pair.h"
#include "bench/haptic/replay_cost.h"
#include "bench/haptic/rows_touch.h"
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

/// T1, and today's coupling beside it, on the lump that it has.
void write_sines(const std::string& out, Runs& runs) {
  Table table{
      {"mode", "tissue", "age", "frequency_Hz", "felt_over_ideal", "felt_phase_deg", "borne_over_ideal",
       "borne_phase_deg", "felt_over_borne", "motor_over_borne", "motor_phase_deg"},
      {}};
  const auto degrees = [](const std::complex<double>& z) { return std::arg(z) * 180 / std::numbers::pi; };
  const auto add = [&](const char* mode, const SineFelt& sine) {
    const SineResult& r = sine.result;
    table.add({mode, sine.specimen, sine.age, text_of(sine.frequency_Hz), text_of(std::abs(r.felt_by_ideal)),
               text_of(degrees(r.felt_by_ideal)), text_of(std::abs(r.borne_by_ideal)),
               text_of(degrees(r.borne_by_ideal)), text_of(std::abs(r.felt_by_borne)),
               text_of(std::abs(r.motor_by_borne)), text_of(degrees(r.motor_by_borne))});
  };
  for (const SineFelt& sine : runs.sines) add(name_of(RenderMode::copy), sine);
  for (const LinkAge& age : link_ages)
    for (const double frequency : touch_frequencies(runs.effort))
      add(name_of(RenderMode::local), {object_models[1].name, age.name, frequency,
                                       feel_sine(todays_case(object_models[1], age), frequency)});
  ResultFolder(out, "haptic_sines").write_csv(table);
}

/// A tap of 0.1 s on O1 at 100 ms, felt and borne, with the copy and as today.
void write_tap(const std::string& out) {
  const SpecimenModel O1 = specimen_of(object_models[1]);
  const TouchRun copy = tap(led_case(O1, link_ages[2]), 0.1, 3e-3);
  const TouchRun today = tap(todays_case(object_models[1], link_ages[2]), 0.1, 3e-3);
  Table table{{"t_s", "depth_mm", "ideal_N", "copy_felt_N", "copy_borne_N", "local_felt_N", "local_borne_N"},
              {}};
  for (std::size_t i = 0; i < std::min(copy.samples.size(), today.samples.size()); ++i) {
    const Touched &c = copy.samples[i], &a = today.samples[i];
    table.add({text_of(c.t), text_of(1e3 * c.x), text_of(c.ideal), text_of(c.felt), text_of(c.borne),
               text_of(a.felt), text_of(a.borne)});
  }
  ResultFolder(out, "haptic_tap").write_csv(table);
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
  nlohmann::json replays = nlohmann::json::array();
  for (const int modes : {1, 3, 9}) {
    const ReplayCost replay = measure_replay(modes, 20'000);
    fmt::print(
        "replay of 100 ticks of {} modes: {:.1f} us median, {:.1f} us p99 (CPU time), {:.1f} % of a tick\n",
        modes, replay.median_us, replay.p99_us, 0.1 * replay.median_us);
    replays.push_back({{"modes", modes}, {"median_us", replay.median_us}, {"p99_us", replay.p99_us}});
  }
  write_sines(options.out, runs);
  write_tap(options.out);
  std::vector<CaseResult> cases = runs.seen;
  cases.insert(cases.end(), runs.copied.begin(), runs.copied.end());
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
                     {"replay_100_ticks_cpu_us", replays},
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
